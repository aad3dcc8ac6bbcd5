//! Answers do not depend on the unit in which they are stated: whatever a table has, in SI it is the same.

use std::f64::consts::PI;

use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::{Input, Output, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tables::{Answer, Table, Values};

const MACHINE: &str = "mechanism Rotor {
    input speed: rpm;
    design k = 40 kN/m +/- 5%;
    design e = 0.2 mm +/- 10%;
    gravity 9.81 m/s^2 along -y;
    body plate: massless; body hub: massless;
    body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
    joint x: prismatic(x) from ground to plate;
    joint y: prismatic(y) from plate to hub;
    joint spin: revolute(z) from hub to disk, driven at speed;
    force a: spring(on: x, stiffness: k); force b: spring(on: y, stiffness: 1.5 * k);
    every displacement: damper(damping: 30 N*s/m);
    unbalance u: on disk, eccentricity: e;
    output shake = x; output sag = 2 * y;
}";

/// SI values of units; those that no test states in another one are 1.
fn scale(unit: &str) -> f64 {
    match unit {
        "um" => 1e-6,
        "mm" => 1e-3,
        "inch" => 0.0254,
        "rpm" => PI / 30.0,
        "Hz" => 2.0 * PI,
        "kN/m" => 1e3,
        "N/mm" => 1e3,
        _ => 1.0,
    }
}

/// The SI values of a table: each number times its unit, of its column or of its row, per that of its variable.
fn si(table: &Table) -> Vec<(String, Vec<Option<f64>>)> {
    let words = |name: &str, row: usize| match table.column(name).map(|column| &column.values) {
        Some(Values::Texts(texts)) => texts[row].clone().unwrap_or_default(),
        _ => String::new(),
    };
    let of_row = |name: &str, row: usize| match name {
        // Pure numbers beside a column of units.
        "sigma level"
        | "skewness"
        | "error of skewness"
        | "amplification"
        | "sigma of amplification"
        | "probability" => 1.0,
        name if name.contains("share") || name.contains("correlation") => 1.0,
        _ => scale(&words("unit", row)) / scale(&words("per", row)),
    };
    let numeric = table.columns.iter().filter_map(|column| match &column.values {
        Values::Numbers(numbers) => Some((column, numbers)),
        _ => None,
    });
    numeric
        .map(|(column, numbers)| {
            let by_row = column.unit.is_empty();
            let value = |(row, number): (usize, &Option<f64>)| {
                let number = (*number)? * scale(&column.unit);
                Some(if by_row { number * of_row(&column.name, row) } else { number })
            };
            (column.name.clone(), numbers.iter().enumerate().map(value).collect())
        })
        .collect()
}

fn compared(question: &str, answers: [Vec<Table>; 2]) -> usize {
    let [plain, stated] = &answers;
    assert_eq!(plain.len(), stated.len(), "{question}");
    let mut compared = 0;
    for (plain, stated) in plain.iter().zip(stated) {
        for ((name, a), (other, b)) in si(plain).into_iter().zip(si(stated)) {
            assert_eq!(name, other, "{question}");
            for (a, b) in a.iter().zip(&b) {
                let close = match (a, b) {
                    (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a.abs().max(1e-30),
                    (a, b) => a == b,
                };
                assert!(close, "{question}, {}, {name}: {a:?} {b:?}", plain.name);
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn answers_do_not_depend_on_the_unit_in_which_they_are_stated() {
    let plain = Interpreted::from_text(MACHINE).unwrap();
    let mut stated = plain.clone();
    for (name, unit) in [("shake", "um"), ("sag", "inch"), ("x", "mm"), ("k", "N/mm"), ("e", "um"), ("speed", "Hz")] {
        stated = stated.in_unit(name, unit).unwrap();
    }
    stated = stated.frequencies_in("rpm").unwrap();
    let declared =
        MACHINE.replace("output shake = x", "output shake: um = x").replace("output sag =", "output sag: inch =");
    let declared = Interpreted::from_text(&declared).unwrap();
    let studies = [plain, stated, declared].map(|machine| Study::new(machine).input(Input::new(0), 100.0).samples(64));
    let speed = Input::<Interpreted>::new(0);
    let range = [60.0, 90.0, 100.0, 110.0, 140.0];
    let shake = Response::Vibration(Vibration::all(studies[0].description())[0]);
    let sag = Response::Output(Output::new(1));
    type Ask = Box<dyn Fn(&Study<Interpreted>) -> Vec<Table>>;
    fn ask<A: Answer, E: std::fmt::Debug>(question: impl Fn(&Study<Interpreted>) -> Result<A, E> + 'static) -> Ask {
        Box::new(move |study| question(study).unwrap().tables())
    }
    let questions: [(&str, Ask); 14] = [
        ("equilibrium", ask(|study| study.equilibrium())),
        ("modes", ask(|study| study.modes())),
        ("outputs", ask(|study| study.outputs())),
        ("output tolerances", ask(|study| study.output_tolerances())),
        ("first order", ask(|study| study.first_order())),
        ("forced response", ask(|study| study.forced_response())),
        ("forced sensitivities", ask(|study| study.forced_sensitivities())),
        ("bode", ask(move |study| study.bode(speed, &range))),
        ("peaks", ask(move |study| study.peaks(Vibration::all(study.description())[0], speed, 60.0, 140.0))),
        ("campbell", ask(move |study| study.campbell(speed, &range, &[1.0]))),
        ("sweep", ask(move |study| study.sweep(speed, &range))),
        ("propagation", ask(move |study| study.propagate(&[shake, sag]))),
        ("worst case", ask(move |study| study.worst_case(&[sag]))),
        (
            "probability",
            ask(move |study| study.probability(&[Requirement::Within { response: sag, low: -1e-3, high: 0.0 }])),
        ),
    ];
    for (name, ask) in &questions {
        let [plain, stated, declared] = studies.each_ref().map(ask);
        assert!(compared(name, [plain.clone(), stated]) > 0, "{name}");
        assert!(compared(name, [plain, declared]) > 0, "{name}");
    }
}

/// The text of a frequency is that of the data in another unit.
#[test]
fn texts_state_frequencies_in_the_unit_of_the_input() {
    let study = Study::new(Interpreted::from_text(MACHINE).unwrap()).input(Input::new(0), 100.0);
    let modes = study.modes().unwrap();
    let hertz = format!("{:.4}", modes.frequencies()[0].unwrap() / (2.0 * PI));
    assert!(modes.to_string().contains(&hertz) && modes.to_string().contains("f [Hz]"), "{modes}");
    let radians = Interpreted::from_text(&MACHINE.replace("speed: rpm", "speed: rad/s")).unwrap();
    assert_eq!(&*radians.description().frequency.symbol, "rad/s");
    let first = Study::new(radians).input(Input::new(0), 100.0).first_order().unwrap().to_string();
    assert!(first.contains("mean [rad/s]"), "{first}");
}
