//! Forced vibration along an input of machines with several branches of equilibria: what follows states without their modes
//! stays on the branch that a sweep with modes follows.

use eigentol::{Excitation, Input, Output, Study};
use eigentol_interpreter::Interpreted;

/// Bars in a row on a turning shaft hang down until it turns fast enough, then every bar may go to either side, which soft
/// springs tell apart; the last is pushed.
fn chain(bars: u32) -> Study<Interpreted> {
    let mut text = String::from(
        "mechanism Chain { input omega: rad/s; design l = 1 m +/- 1%; gravity 9.81 m/s^2 along -z; body b0: massless;
         joint spin: revolute(z) from ground to b0, driven at omega;",
    );
    for k in 1..=bars {
        let place = if k == 1 { "" } else { " at [0, 0, -l]" };
        text += &format!(
            "body b{k}: rod(mass: {k} kg, length: l, along: -z); joint q{k}: revolute(y) from b{} to b{k}{place};
             force air{k}: damper(on: q{k}, damping: 0.3 N*m*s/rad);
             force bias{k}: spring(on: q{k}, stiffness: 2 N*m/rad, rest: {} rad);",
            k - 1,
            0.05 - 0.02 * f64::from(k)
        );
    }
    text +=
        &format!("force push: harmonic(on: q{bars}, moment: 0.01 N*m, frequency: 7 rad/s); output end = q{bars}; }}");
    let study = Study::new(Interpreted::from_text(&text).expect("a declaration"));
    (0..bars as usize).fold(study, |study, k| study.start(eigentol::Coordinate::new(k), 0.1)).samples(16)
}

#[test]
fn states_without_modes_stay_on_the_branch() {
    let mut compared = 0;
    for bars in [1, 2, 3] {
        let study = chain(bars);
        for count in [2_u32, 3, 5, 8, 13, 40] {
            for reversed in [false, true] {
                // The last grid has the values of the first among its own.
                let grid = |steps: u32| {
                    let values = (0..=steps).map(|k| 0.5 + 8.5 * f64::from(k) / f64::from(steps));
                    let mut values: Vec<f64> = values.collect();
                    if reversed {
                        values.reverse();
                    }
                    values
                };
                let (values, within) = (grid(count - 1), 800 / (count - 1));
                let lean = study.bode(Input::new(0), &values).expect("vibrations");
                let whole = study.bode_bands(Input::new(0), &values, &[], 0).expect("vibrations");
                let fine = study.bode(Input::new(0), &grid((count - 1) * within)).expect("vibrations");
                let fine: Vec<_> = fine.points.into_iter().step_by(within as usize).collect();
                for (one, other) in lean.points.iter().zip(&whole.points).chain(lean.points.iter().zip(&fine)) {
                    let text = format!("{bars} bars, {count} values, {} rad/s", one.value);
                    assert_eq!(one.stable, other.stable, "{text}");
                    let amplitude = |point: &eigentol::bode::BodePoint| {
                        let response = &point.vibration.as_ref().ok()?.response;
                        let harmonic = response.harmonic(Excitation::<eigentol::Any>::new(0))?;
                        harmonic.amplitude(Output::new(0), eigentol::forced::Measure::Displacement)
                    };
                    match (amplitude(one), amplitude(other)) {
                        (Some(a), Some(b)) => {
                            assert!((a - b).norm() < 1e-8 * b.norm(), "{text}: {a} {b}");
                            compared += 1;
                        }
                        (a, b) => assert_eq!(a, b, "{text}"),
                    }
                }
            }
        }
    }
    assert!(compared > 700, "{compared}");
}
