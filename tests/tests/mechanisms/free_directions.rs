//! Directions in which nothing determines where a mechanism stands: as many in any coordinates, and as many as the
//! stiffness has null vectors at an equilibrium.

use std::fmt::Write as _;

use eigentol_compiler::mechanics::{Limits, Role};
use eigentol_compiler::{Compilation, Mistakes, compile_text};
use nalgebra::{DMatrix, DVector, SVD};

fn compiled(text: &str) -> Result<Compilation, Mistakes> {
    compile_text(text, Limits::default())
}

/// Null vectors of the stiffness at an equilibrium near `start`, apart from those of reactions alone; `None` if Newton's
/// method finds none in this attempt. Shares no code with the compiler's proof.
fn null_vectors(compilation: &Compilation, start: &[f64], attempt: u64) -> Option<usize> {
    let unknowns = &compilation.functions.unknowns;
    let design: Vec<f64> = compilation.mechanism.design.iter().map(|value| value.nominal).collect();
    let inputs = vec![0.7; compilation.mechanism.inputs.len()];
    let n = unknowns.len();
    let mut numbers = Numbers(attempt);
    let mut beside = || {
        if attempt == 0 { 0.0 } else { 0.3 * numbers.next() }
    };
    let start = (0..n).map(|k| start.get(k).copied().unwrap_or(0.0) + beside());
    let mut q = DVector::from_iterator(n, start);
    let at = |q: &DVector<f64>| {
        let kernel = "residual_and_stiffness";
        let values = compilation.program.evaluate(kernel, &[q.as_slice(), &inputs, &design])?;
        let residual = DVector::from_column_slice(&values[0]);
        Some((residual, DMatrix::from_row_slice(n, n, &values[1])))
    };
    let moves = |role: &Role| matches!(role, Role::Position(_) | Role::Speed(_));
    let moving = unknowns.iter().filter(|unknown| moves(&unknown.role)).count();
    let size = |q: &DVector<f64>| at(q).map_or(f64::INFINITY, |(residual, _)| residual.norm());
    for _ in 0..200 {
        let (residual, stiffness) = at(&q)?;
        let step = SVD::new(stiffness, true, true).solve(&residual, 1e-8).ok()?;
        let mut share = (0.5 / step.rows(0, moving).amax()).min(1.0);
        let near = step.amax() < 1e-5 * (1.0 + q.amax());
        while !near && share > 1e-3 && size(&(&q - &step * share)) > (1.0 - 0.1 * share) * residual.norm() {
            share /= 2.0;
        }
        q -= &step * share;
        if step.amax() < 1e-13 * (1.0 + q.amax()) {
            break;
        }
    }
    let (residual, stiffness) = at(&q)?;
    if residual.amax() > 1e-9 * (1.0 + q.amax()) {
        return None;
    }
    let nullity = |matrix: &DMatrix<f64>| {
        let mut scaled = matrix.clone();
        for mut row in scaled.row_iter_mut() {
            let size = row.amax();
            if size > 1e-9 {
                row /= size;
            }
        }
        let values = SVD::new(scaled, false, false).singular_values;
        matrix.ncols() - values.iter().filter(|value| **value > 1e-8).count()
    };
    let reactions = stiffness.columns(moving, n - moving).into_owned();
    let gauge = if moving == n { 0 } else { nullity(&reactions) };
    Some(nullity(&stiffness) - gauge)
}

/// Asserts that a mechanism has so many free directions, by the compiler and at an equilibrium.
fn assert_free(expected: usize, text: &str, start: &[f64]) {
    let compilation = compiled(text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    assert_eq!(compilation.functions.free.count, expected, "{text}");
    let found = (0..10).find_map(|attempt| null_vectors(&compilation, start, attempt));
    assert_eq!(found, Some(expected), "{text}");
}

/// Numbers between -1 and 1 that look arbitrary and are always the same.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / f64::from(1 << 23) - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() + 1.0) / 2.0 * n as f64) as usize % n
    }

    fn chance(&mut self, share: f64) -> bool {
        self.next() < 2.0 * share - 1.0
    }
}

/// How a mechanism is described.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Coordinates {
    Relative,
    Absolute,
    /// By turns.
    Mixed,
}

const ALL: [Coordinates; 3] = [Coordinates::Relative, Coordinates::Absolute, Coordinates::Mixed];

impl Coordinates {
    fn relative(self, k: usize) -> bool {
        match self {
            Self::Relative => true,
            Self::Absolute => false,
            Self::Mixed => k.is_multiple_of(2),
        }
    }
}

/// Wheels on parallel shafts, joined by springs and gears in the order of a tree; some are held.
fn train(seed: u64, coordinates: Coordinates) -> (usize, String) {
    let mut numbers = Numbers(seed);
    let wheels = 3 + numbers.below(5);
    let mut text = String::from("mechanism Train { ");
    // by wheel: its absolute angle in the coordinates
    let mut angles: Vec<String> = Vec::new();
    // by wheel: the first of those that turn with it, and whether it is held
    let mut trees: Vec<usize> = Vec::new();
    let mut held: Vec<usize> = Vec::new();
    for k in 0..wheels {
        let _ = write!(text, "body w{k}: disk(mass: {} kg, radius: 10 cm, axis: z);", k + 1);
        let before = numbers.below(k.max(1));
        let stiffness = 100.0 + 50.0 * numbers.next();
        let alone = k == 0 || numbers.chance(0.2);
        let geared = numbers.chance(0.3);
        if !alone && !geared && coordinates.relative(k) {
            let _ = write!(
                text,
                "joint q{k}: revolute(z) from w{before} to w{k};
                 design k{k} = {stiffness} N*m/rad; force s{k}: spring(on: q{k}, stiffness: k{k}, rest: 0.1 rad);"
            );
            angles.push(format!("({} + q{k})", angles[before]));
        } else {
            let _ = write!(text, "joint q{k}: revolute(z) from ground to w{k};");
            angles.push(format!("q{k}"));
            if alone {
                // nothing
            } else if geared {
                let ratio = 2.0 + numbers.next();
                let _ = write!(
                    text,
                    "design n{k} = {ratio}; constraint g{k}: equation(zero: q{k} - n{k} * {});",
                    angles[before]
                );
            } else {
                let _ = write!(
                    text,
                    "design k{k} = {stiffness} N*m/rad; force s{k}: potential(energy: k{k} * (q{k} - {} - 0.1 rad)^2 / 2);",
                    angles[before]
                );
            }
        }
        let tree = if alone { k } else { trees[before] };
        trees.push(tree);
        if numbers.chance(0.15) {
            held.push(tree);
            let angle = &angles[k];
            let _ = write!(text, "force h{k}: potential(energy: 3 N*m/rad * ({angle})^2 / 2);");
        }
    }
    let loose = (0..wheels).filter(|k| trees[*k] == *k && !held.contains(k));
    (loose.count(), text + "}")
}

#[test]
fn a_train_has_one_for_every_part_that_nothing_holds() {
    for seed in 0..24 {
        for coordinates in ALL {
            let (loose, text) = train(seed, coordinates);
            assert_free(loose, &text, &[]);
        }
    }
}

/// Bars hinged in a plane, with springs at some hinges; the first may be held at its end.
fn linkage(seed: u64, coordinates: Coordinates) -> (usize, String) {
    let mut numbers = Numbers(seed ^ 0x51);
    let bars = 2 + numbers.below(3);
    let mut text = String::from("mechanism Linkage { ");
    let held = numbers.chance(0.3);
    let mut loose = if held { 0 } else { 3 };
    let slides = numbers.chance(0.5);
    for k in 0..bars {
        let _ = write!(
            text,
            "body b{k}: rod(mass: {} kg, length: 1 m, along: x); point a{k}: b{k}; point e{k}: b{k} at [1 m, 0, 0];",
            k + 1
        );
        let stiffness = 20.0 + 5.0 * numbers.next();
        let sprung = numbers.chance(0.7);
        let before = k.saturating_sub(1);
        if k == 0 && slides {
            let _ = write!(
                text,
                "body s: massless; body t: massless; joint x0: prismatic(x) from ground to s;
                 joint y0: prismatic(y) from s to t; joint q0: revolute(z) from t to b0;"
            );
        } else if k == 0 || !coordinates.relative(k) {
            let _ = write!(text, "joint p{k}: planar(x{k}: x, y{k}: y, q{k}: z) from ground to b{k};");
        } else {
            let _ = write!(text, "joint q{k}: revolute(z) from b{before} to b{k} at [1 m, 0, 0];");
        }
        if k > 0 && !coordinates.relative(k) {
            let _ = write!(text, "constraint h{k}: coincident(from: e{before}, to: a{k}, along: [x, y]);");
        }
        if k > 0 && sprung {
            let _ = write!(
                text,
                "force k{k}: bushing(from: e{before}, to: a{k}, turning_stiffness: [0, 0, {stiffness}] N*m/rad);"
            );
        } else if k > 0 {
            loose += 1;
        }
    }
    if held {
        let _ = write!(
            text,
            "point post: ground at [0.1 m, 0.2 m, 0];
             force hold: bushing(from: post, to: a0, stiffness: [50, 60, 0] N/m, turning_stiffness: [0, 0, 30] N*m/rad);"
        );
    }
    (loose, text + "}")
}

#[test]
fn a_linkage_has_three_and_one_for_every_loose_hinge() {
    for seed in 0..24 {
        for coordinates in ALL {
            let (loose, text) = linkage(seed, coordinates);
            assert_free(loose, &text, &[]);
        }
    }
}

/// A body turns freely about a point of another, which springs hold away from where all coordinates are zero.
#[test]
fn turns_about_a_point_that_moves() {
    let joints = [
        (
            "joint turn: spherical(psi: z, beta: y, phi: x) from arm to ball at [0.4, 0, 0] m;",
            vec![0.3, -0.9, 0.1, 0.4],
        ),
        (
            "joint turn: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to ball;
             point own: ball; constraint pin: coincident(from: end, to: own);",
            vec![0.3, 0.4, 0.1, 0.0, -0.6, 0.1, 0.4],
        ),
        (
            "joint turn: free(px: x, py: y, pz: z, psi: z, beta: x, phi: z) from ground to ball at [1 m, 0, 0];
             point own: ball; constraint pin: coincident(from: end, to: own);",
            vec![0.3, -0.6, 0.1, 0.0, -0.6, 0.4, 0.1],
        ),
    ];
    for (joint, start) in &joints {
        for (more, left) in [
            ("", 3),
            ("force f: bushing(from: end, to: stub, turning_stiffness: [0, 0, 3] N*m/rad);", 2),
            (
                "point far: ball at [0, 0.5, 0] m; point post: ground at [1, 1, 0.5] m;
              force f: spring_damper(from: post, to: far, stiffness: 3 N/m, length: 0.2 m);",
                1,
            ),
        ] {
            let text = format!(
                "mechanism Hung {{
                    body arm: rod(mass: 2 kg, length: 0.4 m, along: x);
                    body ball: rigid(mass: 1 kg, inertia: [0.2, 0.3, 0.4] kg*m^2, center: [0.1, 0.2, 0] m);
                    joint swing: revolute(z) from ground to arm;
                    point end: arm at [0.4, 0, 0] m; point stub: ball;
                    force hold: spring(on: swing, stiffness: 30 N*m/rad, rest: 0.3 rad);
                    {joint} {more}
                }}"
            );
            assert_free(left, &text, start);
        }
    }
}

/// A free body with two panels and a strut that bends them at rest, with different angles, joints and constraints.
#[test]
fn a_spacecraft_has_six_in_any_coordinates() {
    let joints = [
        "joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to craft;",
        "joint fly: free(px: x, py: y, pz: z, psi: z, beta: x, phi: z) from ground to craft;",
        "joint fly: free(px: [1, 1, 0], py: y, pz: [0, 1, 2], psi: [1, 0, 1], beta: y, phi: z) from ground to craft at [1 m, 0, 2 m];",
        "body a: massless; body b: massless; joint pz: prismatic(z) from ground to a; joint px: prismatic(x) from a to b;
         body c: massless; joint py: prismatic(y) from b to c; joint turn: spherical(psi: z, beta: y, phi: x) from c to craft;",
    ];
    let hinges = [
        "joint q1: revolute(x) from craft to left at [0.3, 0.4, 0] m;",
        "joint own: free(lx: x, ly: y, lz: z, l1: z, l2: y, l3: x) from ground to left;
         point on: craft at [0.3, 0.4, 0] m; point end: left;
         constraint pin: coincident(from: on, to: end); constraint axle: aligned(from: on, to: end, axis: x);",
    ];
    for joint in joints {
        for hinge in hinges {
            let text = format!(
                "mechanism Spacecraft {{
                    design k = 22 N*m/rad +/- 2%;
                    body craft: rigid(mass: 40 kg, inertia: [5, 7, 6] kg*m^2);
                    body left: rigid(mass: 3 kg, inertia: [0.4, 0.05, 0.43] kg*m^2, center: [0.1, 0.6, 0] m);
                    body right: rigid(mass: 2 kg, inertia: [0.2, 0.04, 0.22] kg*m^2, center: [0, 0.5, 0.15] m);
                    {joint} {hinge}
                    joint q2: revolute(z) from craft to right at [-0.2, 0.35, 0.1] m;
                    point root: craft at [0.3, 0.4, 0] m;
                    point stub: left;
                    force f1: bushing(from: root, to: stub, turning_stiffness: [30, 0, 0] N*m/rad);
                    force f2: spring(on: q2, stiffness: k, rest: -0.1 rad);
                    point t1: left at [0.2, 1.2, 0] m;
                    point t2: right at [0, 1, 0.3] m;
                    force strut: spring_damper(from: t1, to: t2, stiffness: 60 N/m, length: 0.7 m);
                }}"
            );
            // away from the pose in which a joint is singular
            let start = [0.1, 0.2, -0.1, 0.1, 0.3, -0.2];
            assert_free(6, &text, &start);
        }
    }
}

/// What a ball on a table, a disk and a unicycle leave open: places that only positions know.
#[test]
fn rolling_leaves_places_open() {
    let ball = |more: &str| {
        format!(
            "mechanism Ball {{
                gravity 9.81 m/s^2 along -z;
                body ball: sphere(mass: 1 kg, radius: 5 cm);
                joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to ball at [0, 0, 5 cm];
                point center: ball; point road: ground; point post: ground at [10 cm, 20 cm, 5 cm];
                constraint roll: rolling(wheel: center, radius: 5 cm, on: road);
                {more}
            }}"
        )
    };
    assert_free(5, &ball(""), &[]);
    assert_free(4, &ball("force k: spring(on: px, stiffness: 10 N/m);"), &[]);
    let both = "force k: spring(on: px, stiffness: 10 N/m); force l: spring(on: py, stiffness: 10 N/m, rest: 10 cm);";
    assert_free(3, &ball(both), &[]);
    // the ball may go round the post
    let ring = "force k: spring_damper(from: post, to: center, stiffness: 10 N/m, length: 30 cm);";
    assert_free(4, &ball(ring), &[]);

    let disk = |more: &str| {
        format!(
            "mechanism Disk {{
                design r = 10 cm +/- 1%;
                gravity 9.81 m/s^2 along [0.2, 0, -1];
                body base: massless; body wheel: disk(mass: 2 kg, radius: r, axis: y);
                joint x: prismatic(x) from ground to base at [0, 0, r];
                joint spin: revolute(y) from base to wheel;
                force k: spring(on: x, stiffness: 300 N/m);
                point hub: wheel; point road: ground;
                constraint contact: rolling(wheel: hub, axis: y, radius: r, on: road);
                {more}
            }}"
        )
    };
    assert_free(1, &disk(""), &[]);
    // how far the spring is wound up when the disk is put down
    assert_free(1, &disk("force w: spring(on: spin, stiffness: 3 N*m/rad);"), &[]);
    let rotor = "body fan: disk(mass: 1 kg, radius: 5 cm, axis: z); joint idle: revolute(z) from ground to fan;";
    assert_free(2, &disk(rotor), &[]);

    let unicycle = "mechanism Unicycle {
        body fork: point(mass: 1 kg); body wheel: disk(mass: 1 kg, radius: 0.2 m, axis: y);
        joint travel: planar(x: x, y: y, heading: z) from ground to fork at [0, 0, 0.2 m];
        joint spin: revolute(y) from fork to wheel;
        point hub: wheel; point road: ground;
        constraint contact: rolling(wheel: hub, axis: y, radius: 0.2 m, on: road);
    }";
    assert_free(4, unicycle, &[]);
}

/// A turn about an axis is no motion on the axis; an orientation that nothing depends on is three.
#[test]
fn axes_and_balls_are_counted_at_the_equilibrium() {
    let hung = |body: &str| {
        format!(
            "mechanism Hung {{
                gravity 9.81 m/s^2 along -z; {body}
                joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to load;
                point eye: load; point hook: ground at [0.3 m, 0.1 m, 1 m];
                force rope: spring_damper(from: hook, to: eye, stiffness: 100 N/m, length: 0.8 m);
            }}"
        )
    };
    let start = [0.25, 0.1, 0.05];
    assert_free(3, &hung("body load: sphere(mass: 1 kg, radius: 5 cm);"), &start);
    let pear = "body load: rigid(mass: 1 kg, inertia: [1, 2, 2.5] kg*m^2, center: [0, 0, -10 cm]);";
    assert_free(1, &hung(pear), &start);
    let top = "mechanism Top { gravity 9.81 m/s^2 along -z;
        body top: cylinder(mass: 1 kg, radius: 5 cm, length: 20 cm, axis: z, center: [0, 0, -30 cm]);
        joint hinge: spherical(psi: z, beta: y, phi: x) from ground to top; }";
    assert_free(1, top, &[]);
    let pinned = "mechanism Gyro { body rotor: rigid(mass: 1 kg, inertia: [1, 2, 2.5] kg*m^2);
        joint fly: free(px: x, py: y, pz: z, psi: z, beta: y, phi: x) from ground to rotor;
        point center: rotor; point stand: ground at [10 cm, 0, 0];
        constraint pin: coincident(from: stand, to: center); }";
    assert_free(3, pinned, &[0.1]);
}

/// A motion that only the linearised equations of every design leave free: potentials of small displacements.
#[test]
fn linear_models_count_where_they_rest() {
    let text = "mechanism Planet { design k = 1 MN/m;
        body carrier: disk(mass: 5 kg, radius: 10 cm, axis: z); body planet: disk(mass: 1 kg, radius: 4 cm, axis: z);
        joint c: revolute(z) from ground to carrier;
        joint p: planar(x: x, y: y, turn: z) from ground to planet at [0.1 m, 0, 0];
        point seat: carrier at [0.1 m, 0, 0]; point center: planet;
        force pin: bushing(from: seat, to: center, stiffness: [2, 3, 0] MN/m);
        force mesh: potential(energy: k * (y + 0.04 m * turn)^2 / 2); }";
    assert_free(1, text, &[]);
}

/// A soft spring is a spring, and a centre of mass that is on the axis only nominally is not.
#[test]
fn what_is_held_is_not_free() {
    let held = [
        "mechanism Soft { body a: disk(mass: 1 kg, radius: 1 m, axis: z); body b: disk(mass: 1 kg, radius: 1 m, axis: z);
            joint p: revolute(z) from ground to a; joint q: revolute(z) from ground to b;
            force shaft: potential(energy: 1 MN*m * (p - q)^2 / 2);
            force mount: spring(on: p, stiffness: 1 mN*m/rad); }",
        "mechanism Balanced { design offset = 0 mm +/- 1 mm; gravity 9.81 m/s^2 along -z;
            body bar: rod(mass: 1 kg, length: 1 m, along: x, center: [0, 0, offset]);
            joint q: revolute(y) from ground to bar; }",
        "mechanism Outward { input speed: rad/s; body hub: massless; body bead: point(mass: 1 kg);
            joint spin: revolute(z) from ground to hub, driven at speed;
            joint slide: prismatic(x) from hub to bead at [10 cm, 0, 0]; }",
    ];
    for text in held {
        assert_eq!(compiled(text).expect("a mechanism").functions.free.count, 0);
    }
}

/// Loads that balance at the nominal design or for some inputs only are told; those that never do are mistakes.
#[test]
fn loads_along_free_directions() {
    let carriage = |pull: &str, push: &str| {
        format!(
            "mechanism Carriage {{ input p: N; design a = 5 N +/- 1%; design b = 5 N +/- 1%;
                body front: point(mass: 1 kg); body rear: point(mass: 2 kg);
                joint travel: prismatic(x) from ground to front; joint gap: prismatic(x) from front to rear;
                force buffer: spring(on: gap, stiffness: 10 N/m);
                point hook: front; point tail: rear;
                force engine: load(at: hook, force: [{pull}, 0, 0]);
                force brake: load(at: tail, force: [{push}, 0, 0]); }}"
        )
    };
    let notes = |text: &str| {
        let free = compiled(text).expect("it balances").functions.free;
        [free.notes, Vec::from_iter(free.unbalanced)].concat()
    };
    let free = "free: `travel`; nothing depends on where it stands, so its place is that of the start";
    assert_eq!(notes(&carriage("p", "-p")), [free]);
    let nominal = notes(&carriage("a", "-b"));
    assert_eq!(nominal[0], free);
    assert!(nominal[1].starts_with("the loads along `travel` balance at the nominal design only"));
    for (pull, push) in [("p", "-2 * p"), ("a", "-p")] {
        let some = notes(&carriage(pull, push));
        assert!(some[1].contains("balance for some values of the inputs only"), "{some:?}");
    }
    for (pull, push) in [("a", "-1.1 * b"), ("a", "0 N")] {
        let mistakes = compiled(&carriage(pull, push)).expect_err("it runs away");
        let message = &mistakes.iter().next().expect("a mistake").message;
        assert!(message.ends_with("along `travel`, which nothing holds"), "{message}");
    }
}

/// Ratios are those of the nominal design.
#[test]
fn directions_are_told_with_their_ratios() {
    let text = "mechanism Geared { design n = 2.5 +/- 1%;
        body a: disk(mass: 1 kg, radius: 1 m, axis: z); body b: disk(mass: 1 kg, radius: 1 m, axis: z);
        joint p1: revolute(z) from ground to a; joint p2: revolute(z) from ground to b;
        constraint gear: coupling(of: p2, with: p1, ratio: n); }";
    let notes = compiled(text).expect("a mechanism").functions.free.notes;
    assert_eq!(
        notes,
        ["free: `p1 : p2 = 1 : 2.5`; nothing depends on where they stand, so their place is that of the start"]
    );
}
