//! Tables of results: the numbers of the results in declared units, with the same columns for any values.

use eigentol::sweep::sweep_table;
use eigentol::{InDeclaredUnit, Study, mechanism};
use eigentol_tables::{Answer as _, Table, Values, csv};

mechanism! {
    /// The rotating bar with a closed form: `cos theta = 3 g / (2 l Omega^2)`, `omega^2 = Omega^2 sin^2 theta`.
    mechanism RotatingBar {
        input speed: rpm;
        design l = 1000 mm +/- 30 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: 3 kg, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint theta: revolute(y) from shaft to bar;
        output angle = theta;
    }
}

const RPM: f64 = 60.0;

fn study() -> Study<RotatingBar> {
    Study::new(RotatingBar).input(RotatingBar::speed, InDeclaredUnit(RPM)).start(RotatingBar::theta, 1.0)
}

fn number(table: &Table, name: &str, row: usize) -> f64 {
    let column = table.column(name).unwrap_or_else(|| panic!("no column `{name}`"));
    match &column.values {
        Values::Numbers(values) => values[row].expect("a number"),
        _ => panic!("`{name}` has no numbers"),
    }
}

fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 1e-9 * expected.abs(), "{value} for {expected}");
}

/// `theta`, the frequency and its derivative by the length in m.
fn closed_form() -> [f64; 3] {
    let speed = RPM * std::f64::consts::TAU / 60.0;
    let cos = 3.0 * 9.81 / (2.0 * speed * speed);
    let omega = speed * (1.0 - cos * cos).sqrt();
    // d cos / d l = - cos / l
    [cos.acos(), omega, speed * speed * cos * cos / omega]
}

#[test]
fn values_are_in_declared_units_and_the_operating_point_comes_last() {
    let study = study();
    let state = study.equilibrium().expect("a state");
    let solution = study.modes().expect("a state");
    let [theta, omega, slope] = closed_form();
    let states = &state.tables()[0];
    close(number(states, "theta", 0), theta);
    let modes = &solution.tables()[0];
    close(number(modes, "frequency", 0), omega);
    for table in [states, modes] {
        let last = table.columns.last().expect("columns");
        assert_eq!(last.heading(), "speed [rpm]");
        close(number(table, "speed", 0), RPM);
    }
    let sensitivities = &study.sensitivities().expect("derivatives").tables()[0];
    let Values::Texts(by) = &sensitivities.column("by").expect("variables").values else {
        panic!("words");
    };
    assert_eq!(by[1].as_deref(), Some("l"));
    close(number(sensitivities, "frequency", 1), slope * 1e-3);
    let first = &study.first_order().expect("spreads").tables()[0];
    close(number(first, "sigma of frequency", 0), slope * 0.01);
    close(number(first, "variance share of l", 0), 1.0);
}

#[test]
fn every_table_comes_back_from_its_file() {
    let study = study().samples(50).keep_samples(true);
    let state = study.equilibrium().expect("a state");
    let modes = study.modes().expect("a state");
    let samples = study.monte_carlo().expect("samples");
    let all = [
        state.tables(),
        modes.tables(),
        study.sensitivities().expect("derivatives").tables(),
        study.first_order().expect("spreads").tables(),
        study.second_order().expect("spreads").tables(),
        study.summary().expect("a summary").tables(),
        samples.tables(),
    ];
    for table in all.iter().flatten() {
        let text = csv::to_string(table).expect("text");
        let back = csv::read(&table.name, text.as_bytes()).expect("a table");
        assert_eq!(csv::to_string(&back).expect("text"), text, "{}", table.name);
        assert_eq!(back.rows(), table.rows());
        let heads = |table: &Table| table.columns.iter().map(|column| column.heading()).collect::<Vec<_>>();
        assert_eq!(heads(&back), heads(table));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
    let kept = all[6].last().expect("samples");
    assert_eq!((kept.name.as_str(), kept.rows()), ("samples", 50));
}

#[test]
fn parts_of_a_sweep_are_the_sweep() {
    let study = study();
    let speeds: Vec<f64> = (0..40).map(|k| 6.0 + 0.05 * f64::from(k)).collect();
    let sweep = study.sweep(RotatingBar::speed, &speeds).expect("a sweep");
    let whole = &sweep.tables()[0];
    assert_eq!(whole.columns[0].heading(), "speed [rpm]");
    close(number(whole, "speed", 39), speeds[39] * 60.0 / std::f64::consts::TAU);
    let mut writer = csv::Writer::new(Vec::new());
    for part in sweep.points.chunks(7) {
        let table = sweep_table(&sweep.description, &sweep.inputs, sweep.input, part, 1);
        writer.write(&table).expect("written");
    }
    let parts = String::from_utf8(writer.finish().expect("finished")).expect("text");
    assert_eq!(parts, csv::to_string(whole).expect("text"));
}

/// Against differences of first derivatives, which are checked against a closed form above.
#[test]
fn second_derivatives_are_per_declared_units() {
    let frequency_slope = |length: f64| {
        let study = study().design(RotatingBar::l, InDeclaredUnit(length));
        let table = &study.sensitivities().expect("derivatives").tables()[0];
        number(table, "frequency", 1)
    };
    let step = 1e-2;
    let difference = (frequency_slope(1000.0 + step) - frequency_slope(1000.0 - step)) / (2.0 * step);
    let curvature = study().mode_curvature(0).expect("derivatives");
    let table = &curvature.tables()[0];
    assert_eq!(table.rows(), 4);
    let found = number(table, "Im s", 3);
    assert!((found - difference).abs() < 1e-6 * found.abs(), "{found} {difference}");
    let mixed = [number(table, "lambda", 1), number(table, "lambda", 2)];
    assert!(mixed[0] == mixed[1] && mixed[0] != 0.0, "{mixed:?}");
}

/// `theta'' = -cos / sin (2 + cos^2 / sin^2) / l^2` by the length; for the critical speed `u_c = (3 g / 2 l)^(1/2)` it
/// is `3/4 u_c / l^2`.
#[test]
fn second_derivatives_of_outputs_and_critical_values() {
    let [theta, ..] = closed_form();
    let (sin, cos) = theta.sin_cos();
    let angle = study().output_curvature(RotatingBar::angle);
    let table = &angle.expect("derivatives").tables()[0];
    assert_eq!(table.rows(), 4);
    close(number(table, "angle", 3), -1e-6 * cos / sin * (2.0 + (cos / sin).powi(2)));
    // dtheta/dl = cot theta / l, dtheta/dOmega = 2 cot theta / Omega.
    let mixed = -1e-3 / RPM * 2.0 * cos / sin.powi(3);
    close(number(table, "angle", 1), mixed);
    close(number(table, "angle", 2), mixed);
    let (low, high) = (InDeclaredUnit(1.0), InDeclaredUnit(100.0));
    let critical = study().critical_curvature(RotatingBar::speed, low, high);
    let table = &critical.expect("derivatives").tables()[0];
    assert_eq!(table.rows(), 1);
    let speed = (1.5_f64 * 9.81).sqrt() * 60.0 / std::f64::consts::TAU;
    close(number(table, "speed", 0), 0.75e-6 * speed);
}

/// Hanging, the bar swings at `omega^2 = 3 g / (2 l) - Omega^2`: it resonates with the shaft at `Omega^2 = 3 g / (4 l)`.
#[test]
fn lists_say_how_many_they_are_and_what_each_is() {
    let [low, high] = [10.0, 30.0].map(InDeclaredUnit);
    let crossings = study().crossings(RotatingBar::speed, low, high, 1.0);
    let crossings = crossings.expect("a resonance");
    let text = crossings.findings().to_string();
    assert!(text.starts_with("RotatingBar: 1 crossing\n"), "{text}");
    assert!(text.contains("frequency 1 crosses 1x speed"), "{text}");
    let speed = (0.75_f64 * 9.81).sqrt() * 60.0 / std::f64::consts::TAU;
    assert!(text.contains(&format!("{speed:.4}")), "{text}");
    let table = &crossings.tables()[0];
    close(number(table, "speed", 0), speed);
    assert!(table.column("what happens").is_none());
    let none = crossings[..0].findings();
    assert_eq!(none.to_string(), "no crossings\n");
    assert!(none.into_tables().is_empty() && crossings[..0].tables().is_empty());
}

#[test]
fn a_skewness_has_no_unit() {
    let study = study().samples(50);
    let table = &study.monte_carlo().expect("samples").tables()[0];
    for (name, unit) in [
        ("sigma of frequency", "rad/s"),
        ("greatest of frequency", "rad/s"),
        ("skewness of frequency", ""),
        ("skewness of damping ratio", ""),
    ] {
        assert_eq!(table.column(name).expect(name).unit, unit, "{name}");
    }
}
