//! Reports omit negligible numbers, and say so.

use eigentol::requirement::Requirement;
use eigentol::{Coordinate, DesignVariable, InDeclaredUnit, Input, Study, mechanism};

use crate::common::FREQUENCY;
use crate::common::pendulum::Pendulum;

const OMEGA: Input<Pendulum> = Input::new(0);
const MASS: DesignVariable<Pendulum> = DesignVariable::new(0);

/// About twelve standard deviations away.
const FAR: Requirement = Requirement::Outside { response: FREQUENCY, low: 3.55, high: 5.0 };

/// Hangs at zero, where the angle depends on nothing, and the frequency does not depend on the mass.
fn hanging() -> Study<Pendulum> {
    Study::new(Pendulum).input(OMEGA, 2.0).relative_tolerance(MASS, 0.01)
}

fn assert_quiet(text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= 150 || line.ends_with('.'), "{line}");
    }
    let tiny = |word: &str| word.split_once("e-").is_some_and(|(_, power)| power.len() > 2);
    let words = text.split_whitespace();
    let texts: Vec<&str> = words.filter(|word| tiny(word)).collect();
    assert!(texts.is_empty(), "{texts:?} in\n{text}");
}

#[test]
fn what_has_no_influence_is_named_and_not_listed() {
    let study = hanging();
    let slopes = study.sensitivities().unwrap().to_string();
    assert!(!slopes.contains("/ m ["), "{slopes}");
    assert!(slopes.contains("below 0.1 % of the strongest: m"), "{slopes}");
    let shift = study.equilibrium_shift().unwrap().to_string();
    assert!(shift.contains("All derivatives zero: theta [rad]"), "{shift}");
    let spread = study.first_order().unwrap().to_string();
    assert!(spread.contains("share of l") && !spread.contains("share of m"), "{spread}");
    for text in [slopes, shift, spread, study.equilibrium().unwrap().to_string()] {
        assert_quiet(&text);
    }
}

mechanism! {
    /// Two blocks on springs of their own, with a weak one between them.
    mechanism Blocks {
        design k1 = 100 N/m +/- 3%;
        design k2 = 400 N/m +/- 3%;
        design between = 0.2 N/m;
        body first: point(mass: 1 kg);
        body second: point(mass: 1 kg);
        joint x: prismatic(x) from ground to first;
        joint y: prismatic(x) from ground to second;
        force own: spring(on: x, stiffness: k1);
        force other: spring(on: y, stiffness: k2);
        point here: first at [0, 0, 0];
        point there: second at [0, 0, 0];
        force both: spring_damper(from: here, to: there, stiffness: between);
    }
}

/// A spring affects its own mode, and the other one by a small or rounding-sized share of the variance.
#[test]
fn shares_that_do_not_matter_are_bounds() {
    let spread = |between: f64| {
        let study = Study::new(Blocks).design(Blocks::between, between);
        study.first_order().expect("a spread").to_string()
    };
    for (between, bounds, zeros) in [(0.001, 0, 2), (20.0, 2, 0)] {
        let text = spread(between);
        assert_eq!(text.matches(" <0.1 %").count(), bounds, "{text}");
        assert_eq!(text.matches(" 0.0 %").count(), zeros, "{text}");
        assert_quiet(&text);
    }
}

#[test]
fn a_chance_too_small_to_tell_is_a_bound() {
    let found = hanging().reliability(&[FAR]).unwrap();
    let text = found.to_string();
    assert!(text.contains("< 1.00e-12"), "{text}");
    assert_quiet(&text);
}

#[test]
fn long_diagrams_show_some_points_and_say_how_many() {
    let values: Vec<InDeclaredUnit> = (0..60).map(|k| InDeclaredUnit(f64::from(k) * 0.1)).collect();
    let study = hanging().start(Coordinate::new(0), 0.5);
    let campbell = study.campbell(OMEGA, &values, &[1.0]).unwrap();
    assert_eq!(campbell.points.len(), 60);
    let sweep = study.sweep(OMEGA, &values).unwrap();
    for text in [campbell.to_string(), sweep.to_string()] {
        assert!(text.contains("11 of 60 points are shown"), "{text}");
        assert!(text.lines().count() < 30, "{text}");
        assert_quiet(&text);
    }
    // Both ends are included.
    let text = sweep.to_string();
    assert!(text.contains("\n  5.9 ") && text.contains("\n  0 "), "{text}");
    // The critical speed comes first, with its standard deviation and its main source.
    let first = campbell.to_string();
    let second_row = first.lines().nth(2).unwrap();
    assert!(second_row.contains("critical") && second_row.contains("l 100.0 %"), "{first}");
}
