//! Places on robots against those computed by Pinocchio (`truth/urdf/reference.json`), with fixed and floating bases.

use std::fs;
use std::path::Path;

use eigentol::kernels::PictureKernels;
use eigentol::picture::scene;
use eigentol_interpreter::Interpreted;
use eigentol_urdf::{Base, Options, import};
use serde_json::Value;

use crate::pictures::space::{norm, subtract};

fn read(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = path.join("truth/urdf").join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list").iter();
    list.map(|x| x.as_f64().expect("a number")).collect()
}

#[test]
fn places_are_those_of_pinocchio() {
    let robots: Value = serde_json::from_str(&read("reference.json")).expect("JSON");
    let mut places = 0;
    for robot in robots.as_array().expect("a list") {
        let base = match robot["floating"].as_bool() {
            Some(true) => Base::Floating,
            _ => Base::Fixed,
        };
        let file = robot["file"].as_str().expect("a file");
        let options = Options::default().base(base).damping(false);
        let imported = import(&read(file), &options).expect("a robot");
        let original = |name: &str| -> String {
            let renamed = imported.names.get(name);
            renamed.map_or(name, String::as_str).to_owned()
        };
        let machine = Interpreted::from_text(&imported.declaration).expect("a declaration");
        let kernels: &dyn PictureKernels = &machine;
        let description = kernels.description();
        let names = robot["coordinates"].as_array().expect("names");
        for state in robot["states"].as_array().expect("states") {
            let known = numbers(&state["q"]);
            let unknowns = description.coordinates.iter();
            let q: Vec<f64> = unknowns
                .map(|unknown| {
                    let name = original(&unknown.name);
                    let place = names.iter().position(|known| *known == *name);
                    place.map_or(0.0, |place| known[place])
                })
                .collect();
            let seen = scene(kernels, &q, &[], &[]).expect("a picture");
            let points = state["points"].as_object().expect("points");
            for (name, expected) in points {
                let mut points = seen.points.iter();
                let point = points.find(|point| original(&point.name) == *name);
                let point = point.unwrap_or_else(|| panic!("{file} has {name}"));
                let found = seen.place(point.body, point.place);
                let expected = numbers(expected);
                let apart = norm(subtract(found, [expected[0], expected[1], expected[2]]));
                assert!(apart < 1e-9, "{file}, {name}: {found:?}, {expected:?}");
                places += 1;
            }
        }
    }
    assert!(places >= 18, "{places} places");
}
