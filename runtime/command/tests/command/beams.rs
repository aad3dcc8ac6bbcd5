//! Beams as a user declares them.

use crate::program::{file, folder, run, run_with_input};

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
        assert!(found.err.contains("singular configuration"), "{length}: {}", found.err);
        assert!(found.err.contains("needs coordinates of `stretch`, and `b`"), "{}", found.err);
    }
    let heavy = modes(&clamped("0.7", "gravity 9.81 m/s^2 along -z;"));
    assert!(heavy.code == 1 && heavy.err.contains("`stretch: 2`"), "{}", heavy.err);
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

/// What `check` notes about a declaration, a line each.
fn notes(text: &str) -> Vec<String> {
    let run = run_with_input(&["check", "-"], text);
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{text}");
    let lines = run.out.lines().skip(1);
    lines.map(|line| line.trim().to_owned()).collect()
}

#[test]
fn check_notes_what_is_worth_knowing_about_beams() {
    let plane = "beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2, bending_y: 3)";
    let arm = |rest: &str| {
        notes(&format!(
            "mechanism A {{ body arm: {plane}; joint clamp: fixed from ground to arm; point tip: arm at tip; {rest} }}"
        ))
    };
    let sideways = "`arm` stays straight where a load would bend it: it has no coordinates of `bending_z`";
    let nothing: [&str; 0] = [];
    assert_eq!(arm(""), nothing);
    assert_eq!(arm("gravity 9.81 m/s^2 along -z;"), nothing);
    assert_eq!(arm("gravity 9.81 m/s^2 along y;"), [sideways]);
    assert_eq!(arm("force f: load(at: tip, force: [1, 0, 1] N);"), nothing);
    assert_eq!(arm("force f: load(at: tip, force: [0, 1, 0] N);"), [sideways]);
    assert_eq!(arm("force f: follower(at: tip, moment: [0, 1, 0] N*m);"), nothing);
    assert_eq!(arm("force f: follower(at: tip, moment: [0, 0, 1] N*m);"), [sideways]);
    assert_eq!(
        arm("body pod: point(mass: 1 kg); joint seat: fixed from arm at 0.5 length to pod; gravity 1 m/s^2 along y;"),
        [
            sideways,
            "`arm` carries loads between its ends, so it is split there: `arm_1` starts at `arm`",
            "`arm` carries loads between its ends, so it is split there: `arm_2` starts at `arm_station_1`",
        ]
    );

    let blade = |turned: &str| {
        notes(&format!(
            "mechanism B {{ input speed: rad/s; body hub: massless; body blade: {plane};
                joint spin: revolute(z) from ground to hub, driven at speed;
                joint clamp: fixed from hub to blade at [0.1 m, 0, 0]{turned}; }}"
        ))
    };
    assert_eq!(blade(""), nothing);
    assert_eq!(blade(" rotated(x, 90 deg)"), nothing);

    let shaft = |rest: &str| {
        notes(&format!(
            "mechanism C {{ input speed: rad/s;
                body shaft: beam(length: 1 m, along: x, up: z, section: circle(radius: 5 mm), density: 7850 kg/m^3, modulus: 210 GPa,
                    bending: 3) spinning at speed;
                body wheel: disk(mass: 1 kg, radius: 10 cm, axis: x); joint clamp: fixed from ground to shaft; {rest} }}"
        ))
    };
    let still = "`wheel` is fixed to `shaft` and does not spin with its material; what does is held by a joint driven at the same speed";
    assert_eq!(shaft("joint seat: fixed from shaft at tip to wheel;"), [still]);
    assert_eq!(shaft("joint seat: revolute(x) from shaft at tip to wheel, driven at speed;"), nothing);

    let twisting = notes(
        "mechanism D { body bar: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 2 N*m^2,
            torsion_stiffness: 1 N*m^2, inertia_y: 1 g*m, inertia_z: 1 g*m, bending_y: 3, torsion: 2);
            joint clamp: fixed from ground to bar; }",
    );
    let one = "`bar` twists and bends in one plane only: right as long as it is nearly straight";
    assert_eq!(twisting.first().map(String::as_str), Some(one), "{twisting:?}");
}

/// A stepped shaft and a cone by hand.
#[test]
fn check_weighs_shafts() {
    let text = "mechanism R { input speed: rad/s; design d = 40 mm;
        material heavy: density 8000 kg/m^3, modulus 210 GPa, poisson 0.3;
        body rotor: shaft(along: x, up: z, material: heavy, sections: [[0.4 m, d], [0.2 m, 2 * d]]) spinning at speed;
        body cone: shaft(along: x, up: z, material: heavy, sections: [[1 m, taper(60 mm, 30 mm)]]); }";
    let found = notes(text);
    // 8000 pi / 4 (0.4 0.04^2 + 0.2 0.08^2); 8000 pi / 12 (0.06^2 + 0.06 0.03 + 0.03^2), whose centre is known.
    assert_eq!(found[0], "rotor: 0.600000 m, 12.0637 kg, centre of mass 0.400000 m from its first end");
    assert_eq!(found[1], "cone: 1.00000 m, 13.1947 kg, centre of mass 0.392857 m from its first end");
}
