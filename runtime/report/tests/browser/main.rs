//! Reports in a real browser, headless. Where there is none the tests say so.

mod chrome;

use std::fs;
use std::path::{Path, PathBuf};

use eigentol::{InDeclaredUnit, Study};
use eigentol_interpreter::Interpreted;
use eigentol_report::Report;
use serde_json::json;

use crate::chrome::Chrome;

fn declaration(name: &str) -> String {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let path = examples.join(format!("{name}.mechanism"));
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The rotor with everything that a report can have.
fn rotor() -> Report<Interpreted> {
    let text = declaration("jeffcott_rotor");
    let mechanism = Interpreted::from_text(&text).expect("an example compiles");
    let study = Study::new(mechanism);
    let speed = study.find_input("speed").expect("it has a speed");
    let study = study.input(speed, InDeclaredUnit(3000.0));
    let values: Vec<_> = (0..=40)
        .map(|k| InDeclaredUnit(100.0 * f64::from(k)))
        .collect();
    Report::new(&study)
        .title("A rotor that leans to one side")
        .declaration(text)
        .samples(2000)
        .seed(7)
        .sweep(speed, &values)
        .orders(&[1.0])
}

fn save(report: &Report<Interpreted>, name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.html"));
    report.save(&path).expect("a report is written");
    path
}

/// The page as it is seen, and as it is printed, for people to look at.
#[test]
fn look() {
    let file = save(&rotor(), "rotor");
    let Some(mut chrome) = Chrome::start("look") else {
        return;
    };
    chrome.open(&file);
    println!("{:?}", chrome.complaints);
    fs::write(file.with_extension("png"), chrome.screenshot()).expect("a screenshot is written");
    fs::write(file.with_extension("pdf"), chrome.pdf()).expect("a print is written");
    let _ = json!(0);
}
