//! Closed frames of beams: what they demand out of their plane holds by itself, however many coordinates there are.

use std::f64::consts::PI;

use crate::beams::compared::study;

fn frequencies(text: &str) -> Vec<f64> {
    let modes = study(text, None).modes().expect("modes");
    let own = modes.frequencies().into_iter().flatten();
    own.filter(|frequency| *frequency > 1e-3).collect()
}

/// Beams that bend in one plane, joined end to end to a closed frame whose corners turn by `angle`.
fn frame(sides: usize, coordinates: usize, (angle, more): (f64, &str), root: &str) -> String {
    let mut text = String::new();
    for k in 0..sides {
        let next = (k + 1) % sides;
        text += &format!(
            "body side{k}: beam(length: {} m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 1 N*m^2, bending_y: {coordinates}{more});
            joint corner{k}: fixed from side{k} at tip to side{next} rotated(y, {angle} deg);\n",
            if more.is_empty() { 1.0 } else { PI }
        );
    }
    format!("mechanism Frame {{ {text} joint hold: {root} from ground to side0; }}")
}

/// A free square vibrates first as four clamped-clamped halves: by symmetry its lowest mode is a finite-element number that
/// more coordinates do not move.
#[test]
fn a_square_and_a_triangle_take_any_number_of_coordinates() {
    for (sides, root) in [(4, "planar(u: x, v: z, twist: -y)"), (4, "fixed"), (3, "fixed")] {
        let corner = (-360.0 / sides as f64, "");
        let of = |n| frequencies(&frame(sides, n, corner, root));
        let best = of(8);
        for n in 4..8 {
            let found = of(n);
            let error = found[0] / best[0] - 1.0;
            assert!((-1e-9..2e-3).contains(&error), "{sides} {root} {n}: {error}");
        }
    }
}

/// A ring of two half circles: in its plane `omega^2 = n^2 (n^2 - 1)^2 / (n^2 + 1) EI / (m R^4)`.
#[test]
fn a_ring_of_two_half_circles() {
    let of = |n: usize| {
        let half = ", prebend_y: -180 deg, torsion_stiffness: 1 N*m^2";
        frequencies(&frame(2, n, (-180.0, half), "planar(u: x, v: z, twist: -y)"))
    };
    let exact = (4.0_f64 * 9.0 / 5.0).sqrt();
    for n in 5..12 {
        let found = of(n);
        let bar = [3e-3, 3e-3, 1e-5, 1e-6][(n - 5).min(3)];
        assert!((found[0] / exact - 1.0).abs() < bar, "{n}: {found:?}");
    }
}
