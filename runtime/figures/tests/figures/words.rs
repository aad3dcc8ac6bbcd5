//! Text in a drawing: inside its edges, and without overlaps.

use eigentol_figures::Figure;
use eigentol_figures::figure::{Axis, Colour, Curve, Mark, Panel, Shape};

use crate::machines::save;

/// Width of a letter relative to its size: the mean for DejaVu Sans over the letters used in figures is 0.55.
const LETTER: f64 = 0.56;
/// Height of a line of letters relative to its size.
const LINE: f64 = 0.8;

/// A text and its box: left, top, right, bottom.
type Words = (String, [f64; 4]);

fn words(svg: &str) -> (f64, f64, Vec<Words>) {
    let document = roxmltree::Document::parse(svg).expect("the file is XML");
    let root = document.root_element();
    let size = root.attribute("viewBox").expect("it has a size");
    let size: Vec<f64> = size.split(' ').filter_map(|values| values.parse().ok()).collect();
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    let all = texts.map(|node| {
        let number = |name: &str| -> f64 {
            let own = node.attribute(name).and_then(|x| x.parse().ok());
            own.unwrap_or_else(|| panic!("{name} of a text"))
        };
        let text = node.text().unwrap_or_default().trim().to_owned();
        let (x, y, letter) = (number("x"), number("y"), number("font-size"));
        let long = LETTER * letter * text.chars().count() as f64;
        let before = match node.attribute("text-anchor") {
            Some("middle") => 0.5 * long,
            Some("end") => long,
            _ => 0.0,
        };
        let half = 0.5 * LINE * letter;
        let upwards = node.attribute("transform").is_some_and(|x| x.starts_with("rotate(270"));
        let own = match upwards {
            true => [x - half, y + before - long, x + half, y + before],
            false => [x - before, y - half, x - before + long, y + half],
        };
        (text, own)
    });
    (size[2], size[3], all.collect())
}

/// No text is cut off by the edge of the drawing, and none overlaps another: legend, axes, labels and caption.
pub(crate) fn assert_readable(svg: &str, name: &str) {
    let (width, height, all) = words(svg);
    for (k, (text, own)) in all.iter().enumerate() {
        let [left, top, right, bottom] = *own;
        let inside = left >= 0.0 && top >= 0.0 && right <= width && bottom <= height;
        assert!(inside, "{name}: `{text}` at {own:?} leaves {width} x {height}");
        for (other, there) in &all[..k] {
            let apart = left >= there[2] || there[0] >= right || top >= there[3] || there[1] >= bottom;
            assert!(apart, "{name}: `{text}` at {own:?} covers `{other}` at {there:?}");
        }
    }
}

fn long(what: &str, letters: usize) -> String {
    what.chars().cycle().take(letters).collect()
}

#[test]
fn long_words_are_made_to_fit() {
    let names = |count: usize| (0..count).map(|k| long(&format!("coordinate_{k}_"), 45)).collect();
    let mut shapes = Panel::new(Axis::of_categories(long("coordinate ", 200), names(30)), Axis::new("size", "m"));
    shapes.bars("", Colour::Series(0), (0..30).map(|k| [f64::from(k) - 0.3, f64::from(k) + 0.3, 0.0, 1.0]));
    let mut shares = Panel::new(Axis::new("share", "%"), Axis::of_categories("", names(9)));
    shares.bars("", Colour::Series(1), (0..9).map(|k| [0.0, 9.0, f64::from(k) - 0.3, f64::from(k) + 0.3]));
    let mut curves = Panel::new(Axis::new(long("speed ", 200), "rpm"), Axis::new(long("deflection ", 120), "mm"));
    for k in 0..5 {
        let line = [Some([0.0, 0.0]), Some([1.0, 1.0 + f64::from(k)])];
        let label = long(&format!("curve {k} "), 100);
        curves.curve(Curve::new(label, Colour::Series(k as usize), line));
        curves.label([1.0, 1.0 + f64::from(k)], long(&format!("end {k} "), 40));
    }
    curves.markers("here", Colour::Black, Shape::Ring, [[0.5, 0.5]]);
    curves.marks.push(Mark { label: long("mark ", 90), at: 0.2 });
    let mut alone = Panel::new(Axis::new("time", "s"), Axis::new("angle", "rad"));
    alone.markers("", Colour::Black, Shape::Ring, [[0.0, 0.0], [1.0, 1.0]]);
    alone.label([0.9, 0.5], long("wider than the panel ", 300));
    let caption = vec![long("unbroken", 500), long("one word after the other ", 400)];
    let figure = Figure::new(long("a title ", 300), caption, vec![curves, shapes, shares, alone]);
    save(&figure, "long_words");
}

#[test]
fn the_check_finds_words_that_are_cut_or_covered() {
    let found = |texts: &str| {
        let svg = format!("<svg viewBox=\"0 0 100 100\">{texts}</svg>");
        std::panic::catch_unwind(|| assert_readable(&svg, "made up")).is_err()
    };
    let text = |x: u32, y: u32, anchor: &str| {
        format!("<text x=\"{x}\" y=\"{y}\" font-size=\"10\" text-anchor=\"{anchor}\">abcd</text>")
    };
    assert!(!found(&text(50, 50, "middle")));
    assert!(found(&text(10, 50, "middle")) && found(&text(90, 50, "start")) && found(&text(20, 50, "end")));
    assert!(found(&text(50, 98, "middle")) && found(&text(50, 2, "middle")));
    assert!(found(&(text(50, 50, "middle") + &text(60, 53, "middle"))));
    assert!(!found(&(text(50, 50, "middle") + &text(50, 60, "middle"))));
}
