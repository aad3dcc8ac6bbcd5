//! The example that draws the figures of the paper.

#[path = "../../../../examples/paper_figures.rs"]
#[allow(dead_code, unreachable_pub, reason = "a program of its own")]
mod paper_figures;

#[test]
fn each_figure_of_the_paper_is_drawn() {
    let figures = paper_figures::figures(20).unwrap();
    let numbers: Vec<usize> = figures.iter().map(|figure| figure.0).collect();
    assert_eq!(numbers, [3, 4, 5, 6, 7, 9, 10, 11, 12, 13]);
    for (number, figure) in &figures {
        let text = figure.svg().unwrap();
        assert!(!text.contains("NaN"), "{number}");
        roxmltree::Document::parse(&text).unwrap();
        assert_eq!(figure.panels.len(), if *number == 11 { 2 } else { 1 });
    }
    let drawn = |number: usize| {
        let figure = figures.iter().find(|figure| figure.0 == number);
        &figure.unwrap().1.panels[0]
    };
    for (number, levels) in [(5, 3), (6, 1), (7, 3), (11, 3), (12, 3), (13, 3)] {
        assert_eq!(drawn(number).error_bars.len(), levels, "figure {number}");
    }
    assert!(drawn(6).y.range[1] > 0.0 && drawn(5).y.name.contains("mean"));
    // First order has more points than samples, beside its pole; samples of neighbouring speeds are not the same ones.
    let curve = drawn(7).curves[0].pieces.concat().len();
    let means = &drawn(11).error_bars[2].bars;
    assert!(curve > means.len());
    let apart = (means[0].at[1] - means[1].at[1]).abs();
    assert!(apart > 1e-3, "{apart}");
}
