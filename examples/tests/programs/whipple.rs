//! The bicycle compared with the published benchmark (Meijaard, Papadopoulos, Ruina and Schwab 2007).

use std::fs;

use super::{columns, run, whipple_bicycle};

/// Speeds at which the weave becomes stable and the capsize mode unstable, m/s.
const PUBLISHED: [&str; 2] = ["4.2924", "6.0243"];

#[test]
fn the_bicycle_is_that_of_the_benchmark() {
    let (printed, path) = run(whipple_bicycle::run, "whipple", &["--speeds", "21"]);
    for speed in PUBLISHED {
        assert!(printed.contains(&format!("{speed} m/s")), "{printed}");
    }

    // Table 2 of the paper, v = 10 m/s.
    let columns = columns(&path.join("sweep.csv"));
    assert_eq!(columns["speed"].len(), 21);
    assert_eq!(columns["speed"][20], Some(10.0));
    let mut last: Vec<(f64, f64)> = (1..=4)
        .filter_map(|mode| {
            let growth = columns[&format!("growth_{mode}")][20]?;
            let frequency = columns[&format!("frequency_{mode}")][20].unwrap_or(0.0);
            Some((growth, frequency))
        })
        .collect();
    last.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected = [
        (-24.624_596_350_174_04, 0.0),
        (-3.720_168_404_372_87, 10.906_811_394_762_87),
        (0.161_053_386_531_72, 0.0),
    ];
    assert_eq!(last.len(), expected.len(), "{last:?}");
    for (found, expected) in last.iter().zip(expected) {
        let far = (found.0 - expected.0).hypot(found.1 - expected.1);
        assert!(far < 1e-9, "{found:?}, not {expected:?}");
    }

    let figure = fs::read_to_string(path.join("eigenvalues.svg")).unwrap();
    assert!(figure.starts_with("<svg") && !figure.contains("NaN"));
}
