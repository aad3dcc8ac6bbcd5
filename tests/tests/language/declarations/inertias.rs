//! Welded bodies together need a physically possible inertia: checks the compiler's rule and the run-time requirement
//! against tensors assembled with nalgebra.

use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::{Compilation, compile};
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Unit, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A mass with its central inertia in some frame.
#[derive(Clone, Copy)]
struct Mass {
    mass: f64,
    center: Vector3<f64>,
    inertia: Matrix3<f64>,
}

impl Mass {
    fn moved(self, turn: Rotation3<f64>, offset: Vector3<f64>) -> Self {
        Self { mass: self.mass, center: offset + turn * self.center, inertia: turn * self.inertia * turn.transpose() }
    }
}

/// By how much the largest principal moment of the combined masses falls short of the sum of the other two, relative to
/// the sum of all three.
fn surplus(masses: &[Mass]) -> f64 {
    let total: f64 = masses.iter().map(|m| m.mass).sum();
    let center = masses.iter().map(|m| m.mass * m.center).sum::<Vector3<f64>>() / total;
    let mut inertia = Matrix3::zeros();
    for m in masses {
        let arm = m.center - center;
        let steiner = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
        inertia += m.inertia + m.mass * steiner;
    }
    let moments = SymmetricEigen::new(inertia).eigenvalues;
    (moments.sum() - 2.0 * moments.max()) / moments.sum()
}

struct Random(ChaCha8Rng);

impl Random {
    fn signed(&mut self) -> f64 {
        2.0 * f64::from(self.0.next_u32()) / f64::from(u32::MAX) - 1.0
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::new(self.signed(), self.signed(), self.signed()) * size
    }

    /// A tensor with products of inertia, physically possible or not.
    fn inertia(&mut self) -> Matrix3<f64> {
        let moments = self.vector(0.9).add_scalar(0.7);
        let turn = Rotation3::new(self.vector(3.0));
        turn * Matrix3::from_diagonal(&moments) * turn.transpose()
    }
}

fn list(v: Vector3<f64>) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

fn rigid(m: &Mass, scale: &str) -> String {
    let j = &m.inertia;
    let (diagonal, products) =
        (Vector3::new(j[(0, 0)], j[(1, 1)], j[(2, 2)]), Vector3::new(j[(0, 1)], j[(1, 2)], j[(0, 2)]));
    let entries: Vec<String> =
        diagonal.iter().chain(products.iter()).map(|entry| format!("({entry:?} kg*m^2) * {scale}")).collect();
    format!("rigid(mass: {:?} kg, inertia: [{}], center: {} m)", m.mass, entries.join(", "), list(m.center))
}

/// Two bodies welded with placements on both sides, and a third welded to the second in the other direction.
struct Weld {
    masses: [Mass; 3],
    /// Axis, angle and offset on the `from` and `to` sides of two joints.
    sides: [(Vector3<f64>, f64, Vector3<f64>); 4],
}

impl Weld {
    fn new(random: &mut Random) -> Self {
        let masses = [(); 3].map(|()| Mass {
            mass: 1.0 + 0.5 * random.signed(),
            center: random.vector(0.1),
            inertia: random.inertia(),
        });
        let sides = [(); 4].map(|()| (random.vector(1.0), 3.0 * random.signed(), random.vector(0.3)));
        Self { masses, sides }
    }

    fn side(&self, k: usize, factor: f64) -> (Rotation3<f64>, Vector3<f64>) {
        let (axis, angle, offset) = self.sides[k];
        (Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle), offset * factor)
    }

    /// The masses in the frame of the first one; the last mass and the offsets of the first joint scale with the
    /// design.
    fn together(&self, scale: f64) -> Vec<Mass> {
        let mut third = self.masses[2];
        third.inertia *= scale;
        // Joint one leads from body 1 to body 2, joint two from body 3 to body 2.
        let through = |m: Mass, near: usize, far: usize, factor: f64| {
            let (turn, offset) = self.side(far, factor);
            let back = turn.inverse();
            let (on, seat) = self.side(near, factor);
            m.moved(back, -(back * offset)).moved(on, seat)
        };
        let second = through(self.masses[1], 0, 1, scale);
        let third = through(through(third, 3, 2, 1.0), 0, 1, scale);
        vec![self.masses[0], second, third]
    }

    fn source(&self, nominal: f64) -> String {
        let placed = |k: usize, factor: &str| {
            let (axis, angle, offset) = self.sides[k];
            format!("at {factor} * {} m rotated({}, {angle:?})", list(offset), list(axis))
        };
        format!(
            "mechanism Welded {{
                design s = {nominal:?};
                body base: sphere(mass: 1 kg, radius: 1 m);
                body one: {};
                body two: {};
                body three: {};
                joint tilt: revolute(y) from ground to base;
                joint turn: revolute(x) from base to one;
                joint weld: fixed from one to two {}, {} on two;
                joint other: fixed from three to two {}, {} on two;
                force a: spring(on: tilt, stiffness: 1 N*m/rad);
                force b: spring(on: turn, stiffness: 1 N*m/rad);
            }}",
            rigid(&self.masses[0], "1"),
            rigid(&self.masses[1], "1"),
            rigid(&self.masses[2], "s"),
            placed(0, "s"),
            placed(1, "s"),
            placed(2, "1"),
            placed(3, "1"),
        )
    }
}

fn compiled(source: &str) -> Result<Compilation, String> {
    let tokens = source.parse().expect("tokens of Rust");
    compile(tokens, Limits::default()).map_err(|mistakes| mistakes.to_string())
}

#[test]
fn welded_bodies_are_judged_together() {
    let mut random = Random(ChaCha8Rng::seed_from_u64(14));
    let (mut accepted, mut refused, mut kept, mut broken, mut made_up) = (0, 0, 0, 0, 0);
    for _ in 0..200 {
        let weld = Weld::new(&mut random);
        let nominal = surplus(&weld.together(1.0));
        let compilation = match compiled(&weld.source(1.0)) {
            Ok(compilation) => compilation,
            Err(text) => {
                assert!(nominal < 0.0, "{nominal}\n{text}");
                assert!(text.contains("belongs to no body"), "{text}");
                refused += 1;
                continue;
            }
        };
        assert!(nominal > 0.0, "{nominal}\n{}", weld.source(1.0));
        accepted += 1;
        made_up += usize::from(weld.masses.iter().any(|m| surplus(&[*m]) < 0.0));
        let kernel = compilation.program.kernel("violation").expect("a kernel");
        for scale in [0.5, 0.8, 1.0, 1.5, 3.0, 8.0] {
            let surplus = surplus(&weld.together(scale));
            let values = kernel.evaluate(&[&[], &[scale]]).concat();
            let holds = values.iter().all(|&value| value > 0.0);
            assert_eq!(holds, surplus > 0.0, "{surplus} {values:?}");
            if holds { kept += 1 } else { broken += 1 }
        }
    }
    // Every case occurs, including one body making up for another.
    let counts = [accepted, refused, kept, broken, made_up];
    assert!(counts.iter().all(|&count| count >= 5), "{counts:?}");
}

#[test]
fn what_is_welded_to_the_ground_may_be_anything() {
    let source = |to: &str| {
        format!(
            "mechanism Base {{
                body plate: rigid(mass: 1 kg, inertia: [1, 1, 30] kg*m^2);
                body bar: rod(mass: 1 kg, length: 1 m, along: -z);
                joint weld: {to};
                joint theta: revolute(y) from plate to bar;
                gravity 9.81 m/s^2 along -z;
                force k: spring(on: theta, stiffness: 1 N*m/rad);
            }}"
        )
    };
    assert_eq!(compiled(&source("fixed from ground to plate")).err(), None);
    let loose = source("revolute(y) from ground to plate");
    let text = compiled(&loose).expect_err("a plate that no body is");
    assert!(text.contains("Jxx + Jyy = 2 kg*m^2 is less than Jzz = 30 kg*m^2"), "{text}");
}

/// Moments by an expression of design variables, about the centre of mass or another point, against the mass matrix of a
/// body on three hinges: `J` about the point on the hinges.
#[test]
fn moments_by_an_expression() {
    let found = |inertia: &str, axis: &str| {
        let source = format!(
            "mechanism Top {{
                kernels only;
                design m = 2 kg; design r = 3 cm; let s = [1, 2, 2.5];
                body b: rigid(mass: m, {inertia});
                joint q: revolute({axis}) from ground to b;
            }}"
        );
        let compilation = compiled(&source).unwrap_or_else(|text| panic!("{text}"));
        let linear = |design: [f64; 2]| {
            let values = compilation.program.evaluate("linear", &[&[0.0], &[], &design]);
            values.expect("a kernel")[0][0]
        };
        [[2.0, 0.03], [2.5, 0.04]].map(linear)
    };
    for (axis, factor) in [("x", 1.0), ("y", 2.0), ("z", 2.5)] {
        let own = |[m, r]: [f64; 2]| factor * m * r * r;
        let expected = [[2.0, 0.03], [2.5, 0.04]].map(own);
        for inertia in
            ["inertia: m * r^2 * [1, 2, 2.5]", "inertia: m * (r * r) * s", "inertia: (m * r) * [r, 2 * r, 2.5 * r]"]
        {
            let found = found(inertia, axis);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-14, "{inertia}: {found}");
            }
        }
        let numbers = found("inertia: (2 kg) * [9, 18, 22.5] cm^2", axis);
        assert!((numbers[0] / expected[0] - 1.0).abs() < 1e-14, "{numbers:?}");
        // The centre is 1 m along x; about the hinge the moments across x are larger by m (1 m)^2.
        let moved = found("inertia: m * [1, 2, 2.5] m^2, center: [1, 0, 0] m, about: [0, 0, 0]", axis);
        assert!((moved[1] / (2.5 * factor) - 1.0).abs() < 1e-14, "{moved:?}");
    }
}
