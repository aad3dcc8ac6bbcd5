//! Figures written to files.

use eigentol_figures::figure::{Axis, Colour, Curve, Mark, Panel, Point, Shape};
use eigentol_figures::{Error, Figure, Style, campbell};

use crate::machines::{rotor_diagram, save};

fn line(slope: f64) -> Vec<Option<Point>> {
    (0..=10).map(f64::from).map(|x| Some([x, slope * x])).collect()
}

fn figure(curves: usize) -> Figure {
    let mut panel = Panel::new(Axis::new("speed", "rpm"), Axis::new("a < b & c", ""));
    for k in 0..curves {
        panel.curve(Curve::new(format!("curve {k}"), Colour::Series(k), line(k as f64)));
    }
    panel.marks.push(Mark { label: "here".to_owned(), at: 3.0 });
    Figure::new("lines", vec!["a caption".to_owned()], vec![panel])
}

/// Counts lines as thick as curves.
fn thick_lines(text: &str) -> usize {
    let document = roxmltree::Document::parse(text).expect("the file is XML");
    let lines = document.descendants().filter(|node| node.has_tag_name("polyline"));
    lines.filter(|node| node.attribute("stroke-width") == Some("6")).count()
}

#[test]
fn a_solid_curve_is_one_line_and_one_in_the_legend() {
    for curves in 1..4 {
        let text = save(&figure(curves), &format!("lines_{curves}"));
        assert_eq!(thick_lines(&text), 2 * curves);
    }
}

#[test]
fn words_are_text_of_the_file() {
    let text = figure(1).svg().unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let words: Vec<&str> = document.descendants().filter_map(|node| node.text()).map(str::trim).collect();
    for expected in ["lines", "curve 0", "here", "a caption", "speed [rpm]", "a < b & c"] {
        assert!(words.contains(&expected), "{expected}: {words:?}");
    }
}

#[test]
fn a_figure_is_data() {
    let figure = campbell(&rotor_diagram(5), &Style::default()).unwrap();
    let json = serde_json::to_value(&figure).unwrap();
    let curve = &json["panels"][0]["curves"][0];
    assert_eq!(curve["colour"], "#0072b2");
    assert!(curve["pieces"][0][0][0].is_number() && curve["pieces"][0][0][1].is_number());
    assert!(!json.to_string().contains("null"), "every number is finite");
}

#[test]
fn an_empty_figure_can_be_drawn() {
    for figure in [Figure::default(), Figure::new("", vec![], vec![Panel::default()])] {
        let text = figure.svg().unwrap();
        assert!(roxmltree::Document::parse(&text).is_ok());
    }
}

#[test]
fn points_outside_the_ranges_are_not_drawn() {
    let mut cut = figure(1);
    cut.panels[0].markers("", Colour::Black, Shape::Disc, [[2.0, 1e300], [5.0, 0.0]]);
    let circles = cut.svg().unwrap().matches("<circle").count();
    assert_eq!(circles, 1);
}

#[test]
fn the_ending_of_a_file_decides() {
    let error = figure(1).save("figure.pdf").unwrap_err();
    assert!(matches!(error, Error::Ending { .. }), "{error}");
    let error = figure(1).save("no/such/folder/figure.svg").unwrap_err();
    assert!(matches!(error, Error::Write { .. }), "{error}");
}

#[cfg(feature = "png")]
#[test]
fn a_png_file_has_dark_letters_on_white() {
    let bytes = figure(2).png().unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.width, 2880);
    let row = 3 * info.width as usize;
    // The title is in the top 48 rows of pixels as shown, each three rows of the file.
    let title = &pixels[..144 * row];
    let dark = title.chunks(3).filter(|chunk| chunk.iter().all(|c| *c < 80)).count();
    let white = title.chunks(3).filter(|chunk| chunk.iter().all(|c| *c == 255)).count();
    assert!(dark > 300 && white > 100 * dark / 2, "{dark} {white}");
}
