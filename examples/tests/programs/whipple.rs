//! The bicycle compared with the published benchmark (Meijaard, Papadopoulos, Ruina and Schwab 2007).

use eigentol::Study;

use super::whipple_bicycle::{self, WhippleBicycle};
use super::{near, printed, shows};

#[test]
fn the_bicycle_is_that_of_the_benchmark() {
    let text = printed(whipple_bicycle::run);
    shows(&text, &["4.29238", "6.02426", "4.2924", "6.0243"]);

    let study = Study::new(WhippleBicycle);
    let none: &[f64] = &[];
    let along = study.campbell(WhippleBicycle::v, &whipple_bicycle::speeds(), none).unwrap();
    near("weave", along.flutter_onsets.last().unwrap().value, 4.292_382_536_341_11, 1e-9);
    assert_eq!(along.critical.len(), 1);
    near("capsize", along.critical[0].value, 6.024_262_015_388_37, 1e-9);

    // Table 2 of the paper, v = 10 m/s.
    let last = along.points.last().unwrap();
    assert_eq!(last.value, 10.0);
    let mut derived: Vec<(f64, f64)> =
        (last.modes.as_ref().unwrap().iter()).map(|mode| (mode.s.re, mode.s.im)).collect();
    derived.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected =
        [(-24.624_596_350_174_04, 0.0), (-3.720_168_404_372_87, 10.906_811_394_762_87), (0.161_053_386_531_72, 0.0)];
    assert_eq!(derived.len(), expected.len(), "{derived:?}");
    for (found, expected) in derived.iter().zip(expected) {
        let far = (found.0 - expected.0).hypot(found.1 - expected.1);
        assert!(far < 1e-9, "{found:?}, not {expected:?}");
    }
}
