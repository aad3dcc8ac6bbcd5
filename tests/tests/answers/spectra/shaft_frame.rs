//! A mass on a shaft of two stiffnesses, in coordinates that turn with it. With a drag `c` of the air around, it is in
//! equilibrium away from the axis where `(k_x - m w^2) (k_y - m w^2) + (c w)^2 = 0`: at such a speed anywhere on a line,
//! because the mechanism is linear.

use eigentol::{Stability, Study, mechanism};

mechanism! {
    /// A flat shaft that carries a mass.
    mechanism FlatShaft {
        input speed: rad/s;
        design k_x = 100 N/m;
        design k_y = 140 N/m;
        design air = 0.8 N*s/m;
        body shaft: massless;
        body mass: point(mass: 1 kg);
        joint turn: revolute(z) from ground to shaft, driven at speed;
        joint place: planar(u: x, v: y, twist: z) from shaft to mass, twist driven at 0 rad/s;
        force along: spring(on: u, stiffness: k_x);
        force across: spring(on: v, stiffness: k_y);
        point there: mass;
        force around: drag(at: there, damping: air);
    }
}

#[test]
fn where_the_input_stands_still_the_mass_rests_anywhere() {
    let study = Study::new(FlatShaft);
    let found = study.branches(FlatShaft::speed, 0.0, 15.0).expect("branches");
    // x^2 + (c^2 - k_x - k_y) x + k_x k_y = 0 for the square of the speed, with a mass of one.
    let half = 0.5 * (240.0 - 0.64);
    let root = f64::sqrt(half * half - 14_000.0);
    let critical = [half - root, half + root].map(f64::sqrt);
    assert_eq!(found.branches.len(), 5);
    let [axis, lines @ ..] = &found.branches[..] else { panic!("no branch") };
    let changes: Vec<Stability> = axis.stretches().iter().map(|(x, _)| *x).collect();
    let divergent = Stability::Divergent { negative: 1 };
    assert_eq!(changes, [Stability::Stable, divergent, Stability::Stable]);
    for line in lines {
        let [(stability, points)] = line.stretches()[..] else { panic!("{:?}", line.stretches().len()) };
        assert_eq!(stability, Stability::Neutral { zero: 1 });
        let value = points[0].value;
        assert!(critical.iter().any(|own| (own - value).abs() < 1e-9 * value), "{value}");
    }
}
