//! A beam beside a chain of rigid bars: error, operations and time of the same cantilever.

use std::fmt::Write;
use std::time::Instant;

use eigentol::{Input, Study};
use eigentol_interpreter::Interpreted;

use crate::beams::compared::{machine, numbers, truth};

/// A uniform cantilever of unit length, stiffness and mass on a hub that spins across it.
fn on_hub(carried: &str) -> String {
    format!(
        "mechanism Cantilever {{
            input gamma: rad/s;
            body hub: massless;
            joint spin: revolute(z) from ground to hub, driven at gamma;
            {carried}
        }}"
    )
}

fn beam(coordinates: usize) -> String {
    on_hub(&format!(
        "body blade: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2,
            bending_y: {coordinates});
        joint clamp: fixed from hub to blade;"
    ))
}

/// Hinges in the middle of `n` equal pieces, with springs of `EI / h`; the first half piece is held, the last is free.
fn bars(n: usize) -> String {
    let h = 1.0 / n as f64;
    let mut text = format!("body root: rod(mass: {} kg, length: {} m, along: x);", h / 2.0, h / 2.0);
    text += "joint clamp: fixed from hub to root;";
    for k in 1..=n {
        let length = if k == n { h / 2.0 } else { h };
        let (before, reach) = match k {
            1 => ("root".to_owned(), h / 2.0),
            _ => (format!("bar{}", k - 1), h),
        };
        let stiffness = n as f64;
        text += &format!(
            "body bar{k}: rod(mass: {length} kg, length: {length} m, along: x);
            joint hinge{k}: revolute(y) from {before} to bar{k} at [{reach}, 0, 0] m;
            force spring{k}: spring(on: hinge{k}, stiffness: {stiffness} N*m/rad);"
        );
    }
    on_hub(&text)
}

/// What one model of the cantilever costs, and its errors at rest and spinning.
struct Row {
    name: String,
    operations: usize,
    microseconds: f64,
    errors: [[f64; 3]; 2],
}

impl Row {
    fn new(name: String, text: &str, exact: &[[f64; 3]; 2]) -> Self {
        let machine = machine(text);
        let linear = machine.description().kernels.iter();
        let linear = linear.filter(|linear| linear.name == "linear");
        let operations = linear.map(|linear| linear.operations + linear.functions).sum();
        let errors = [0, 1].map(|k| {
            let study = Study::new(machine.clone()).input(Input::new(0), [0.0, 5.0][k]);
            let modes = study.modes().expect("modes");
            let values: Vec<f64> = modes.frequencies().into_iter().flatten().collect();
            std::array::from_fn(|mode| (values[mode] / exact[k][mode] - 1.0).abs())
        });
        // a study remembers what it has found
        let seconds = (0..20).map(|_| {
            let study = Study::new(machine.clone()).input(Input::new(0), 5.0);
            let start = Instant::now();
            study.modes().expect("modes");
            start.elapsed().as_secs_f64()
        });
        Self { name, operations, microseconds: 1e6 * seconds.fold(f64::INFINITY, f64::min), errors }
    }
}

/// The rows as the table of the guide.
fn table(rows: &[Row]) -> String {
    let mut text = "| model | at rest: modes 1, 2, 3 | `gamma` 5 | operations | modes |\n".to_owned();
    text += "| --- | --- | --- | ---: | ---: |\n";
    for row in rows {
        let errors = row.errors.map(|all| all.map(|x| format!("{x:.0e}")).join(", "));
        let [rest, spinning] = errors;
        let (name, operations, time) = (&row.name, row.operations, row.microseconds);
        writeln!(text, "| {name} | {rest} | {spinning} | {operations} | {time:.0} us |").expect("a string");
    }
    text
}

#[test]
fn a_few_coordinates_replace_many_bars() {
    let file = truth(include_str!("../../../truth/flexible/F1_rotating_euler.json"));
    let cases = file["dimensionless"].as_array().expect("cases");
    let exact = [0.0, 5.0].map(|gamma| {
        let case = cases.iter().find(|case| case["motion"] == "flap" && case["delta"] == 0.0 && case["gamma"] == gamma);
        let all = numbers(&case.expect("a case")["frequencies"]);
        [all[0], all[1], all[2]]
    });
    let beams = [4, 6, 8].map(|n| Row::new(format!("beam, {n} coordinates"), &beam(n), &exact));
    let chains = [8, 16, 32].map(|n| Row::new(format!("{n} bars"), &bars(n), &exact));
    for speed in 0..2 {
        for mode in 0..3 {
            let of = |row: &Row| row.errors[speed][mode];
            for rows in [&beams, &chains] {
                assert!(of(&rows[0]) > of(&rows[1]) && of(&rows[1]) > of(&rows[2]), "mode {mode}");
            }
            // bars converge with the square of their length
            for pair in chains.windows(2) {
                let order = (of(&pair[0]) / of(&pair[1])).log2();
                assert!((order - 2.0).abs() < 0.3, "mode {mode}: {order}");
            }
            // six coordinates are better than 32 bars, in every mode by rule and the one above
            assert!(of(&beams[1]) < of(&chains[2]), "mode {mode}");
            assert!(of(&beams[2]) < 1e-2 * of(&chains[2]), "mode {mode}");
        }
    }
    let rows: Vec<Row> = beams.into_iter().chain(chains).collect();
    print!("{}", table(&rows));
}

/// No coordinates of stretch and shear are what a beam has without these numbers.
#[test]
fn none_is_a_number_of_coordinates() {
    let frequencies = |more: &str| {
        let text = format!(
            "mechanism Bar {{
                body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2, {more});
                joint clamp: fixed from ground to bar; }}"
        );
        let machine = Interpreted::from_text(&text).map_err(|error| error.to_string())?;
        let modes = Study::new(machine).modes().expect("modes");
        Ok::<_, String>(modes.frequencies())
    };
    let plain = frequencies("bending_y: 3").expect("a beam");
    for more in ["stretch: 0", "shear: 0", "stretch: 0, shear: 0", "torsion: 0"] {
        let found = frequencies(&format!("bending_y: 3, {more}"));
        assert_eq!(found.expect("a beam"), plain, "{more}");
    }
    let rigid = frequencies("bending_y: 0, stretch: 0").expect_err("no coordinates");
    assert!(rigid.contains("it is rigid"), "{rigid}");
}
