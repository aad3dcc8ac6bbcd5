//! Beams as a user declares them.

use crate::program::{file, folder, run};

/// A straight beam between two walls, whose length is rounded in the gap of its far end.
fn clamped(length: &str, more: &str) -> String {
    format!(
        "mechanism Clamped {{ input load: N; {more}
         material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
         body b: beam(length: {length} m, along: x, up: z, section: circle(radius: 5 mm), material: steel);
         joint near: fixed from ground to b;
         joint far: fixed from b at tip to ground at [{length} m, 0, 0] on ground; }}"
    )
}

#[test]
fn a_straight_beam_between_walls_is_told_what_it_needs() {
    let folder = folder("clamped");
    let modes = |text: &str| run(&["modes", &file(&folder, "clamped.mechanism", text)]);
    for length in ["0.3", "0.33", "0.4", "0.7", "0.9", "1", "1.3", "1.7", "2.3"] {
        let found = modes(&clamped(length, ""));
        assert_eq!(found.code, 1);
        assert!(
            found.err.contains("singular configuration"),
            "{length}: {}",
            found.err
        );
        assert!(
            found
                .err
                .contains("needs coordinates of `stretch`, and `b`"),
            "{}",
            found.err
        );
    }
    let heavy = modes(&clamped("0.7", "gravity 9.81 m/s^2 along -z;"));
    assert!(
        heavy.code == 1 && heavy.err.contains("`stretch: 2`"),
        "{}",
        heavy.err
    );
    let stretched = clamped("0.7", "").replace("material: steel)", "material: steel, stretch: 2)");
    assert_eq!(modes(&stretched).code, 0);
}

/// The advice is for beams in loops only.
#[test]
fn a_machine_without_such_a_beam_is_not_advised() {
    let text = "mechanism Bars { design l = 1 m; body a: rod(mass: 1 kg, length: l, along: x);
        body b: rod(mass: 1 kg, length: l, along: x); gravity 9.81 m/s^2 along -z;
        joint p: revolute(y) from ground to a; joint q: revolute(y) from a to b at [l, 0, 0];
        joint r: revolute(y) from b to ground at [l, 0, 0], at [3 m, 0, 0] on ground, cut; }";
    let found = run(&["modes", &file(&folder("bars"), "bars.mechanism", text)]);
    assert_eq!(found.code, 1, "{}", found.out);
    assert!(!found.err.contains("stretch"), "{}", found.err);
}
