//! Random bordered pencils: every reported root is one, left and right; no two are the same; and their number matches
//! the freedom.

use eigentol::kernels::Linear;
use eigentol::modes::modes_of;
use eigentol::{Complex, CoordinateInfo, DampingKind, Description, Family, Mode, Role, Shared, Unit, Vector};

const NONE: Unit = Unit { symbol: Shared::Static(""), scale: 1.0 };

/// The test's own random number generator, uniform in (-1, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The number of unknowns in each role.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    coordinates: usize,
    speeds: usize,
    positions: usize,
    velocities: usize,
    /// Rows that are combinations of other rows of the same kind.
    copies: [usize; 2],
}

impl Sizes {
    fn description(self) -> Shared<Description> {
        let info = |role| CoordinateInfo { name: "x".into(), unit: NONE, role };
        let mut all = vec![info(Role::Position); self.coordinates];
        all.extend(vec![info(Role::Speed); self.speeds]);
        all.extend(vec![info(Role::PositionReaction); self.positions]);
        all.extend(vec![info(Role::VelocityReaction); self.velocities]);
        let description = Description {
            name: Shared::Static("Random"),
            coordinates: all.into(),
            inputs: Shared::Static(&[]),
            design: Shared::Static(&[]),
            excitations: Shared::Static(&[]),
            outputs: Shared::Static(&[]),
            symmetric_stiffness: false,
            free_directions: 0,
            held: Shared::Static(&[]),
            length: 1.0,
            frequency: eigentol::Unit::si("rad/s"),
            resolved_modes: None,
            correlations: eigentol::Shared::Static(&[]),
            rings: eigentol::Shared::Static(&[]),
            spans: eigentol::Shared::Static(&[]),
            harmonics: eigentol::Shared::Static(&[]),
            damping: DampingKind::General,
            kernels: Shared::Static(&[]),
        };
        Shared::Counted(description.into())
    }

    fn unknowns(self) -> usize {
        self.coordinates + self.speeds + self.positions + self.velocities
    }

    /// Number of eigenvalues.
    fn freedom(self) -> usize {
        let y = self.coordinates + self.copies[0] - self.positions;
        let w = y + self.speeds + self.copies[1] - self.velocities;
        y + w
    }
}

fn linear(sizes: Sizes, random: &mut Random) -> Linear {
    let mut linear = Linear::zeros(sizes.unknowns());
    let (q, motions) = (sizes.coordinates, sizes.coordinates + sizes.speeds);
    let factor: Vec<Vec<f64>> = (0..motions).map(|_| (0..motions).map(|_| random.next()).collect()).collect();
    for i in 0..motions {
        for j in 0..motions {
            let product: f64 = (0..motions).map(|k| factor[i][k] * factor[j][k]).sum();
            let mass = product + if i == j { 0.3 } else { 0.0 };
            let (damping, stiffness) = (random.next(), 5.0 * random.next());
            if j < q {
                linear.mass[i][j] = mass;
                linear.damping[i][j] = damping;
                linear.stiffness[i][j] = stiffness;
            } else {
                linear.damping[i][j] = mass;
                linear.stiffness[i][j] = damping;
            }
        }
    }
    let first = motions;
    let independent = sizes.positions - sizes.copies[0];
    for k in 0..sizes.positions {
        let row: Vec<f64> = if k < independent {
            (0..q).map(|_| random.next()).collect()
        } else {
            (0..q).map(|j| 3.0 * linear.stiffness[first + k - independent][j]).collect()
        };
        for (j, value) in row.into_iter().enumerate() {
            linear.stiffness[first + k][j] = value;
            linear.stiffness[j][first + k] = value;
        }
    }
    let first = motions + sizes.positions;
    let independent = sizes.velocities - sizes.copies[1];
    for k in 0..sizes.velocities {
        for j in 0..motions {
            let (rate, at_rest) = if k < independent {
                (random.next(), random.next())
            } else {
                let row = first + k - independent;
                if j < q {
                    (0.5 * linear.damping[row][j], 0.5 * linear.stiffness[row][j])
                } else {
                    (0.5 * linear.stiffness[row][j], 0.0)
                }
            };
            if j < q {
                linear.damping[first + k][j] = rate;
                linear.stiffness[first + k][j] = at_rest;
            } else {
                linear.stiffness[first + k][j] = rate;
            }
            linear.stiffness[j][first + k] = rate;
        }
    }
    linear
}

/// Rescales unknowns, and with them the equations of motion, to units that differ by orders of magnitude.
fn rescale(linear: &mut Linear, random: &mut Random) {
    let n = linear.mass.row_count();
    let units = Vector::from_fn(n, |_| 10_f64.powf(2.0 * random.next()));
    for matrix in [&mut linear.mass, &mut linear.damping, &mut linear.stiffness] {
        for i in 0..n {
            for j in 0..n {
                matrix[i][j] *= units[i] * units[j];
            }
        }
    }
}

fn times(linear: &Linear, factors: [Complex; 3], x: &[Complex]) -> (Vector<Complex>, f64) {
    let mut size = 0.0_f64;
    let product = Vector::from_fn(x.len(), |i| {
        let mut sum = Complex::default();
        let mut terms = 0.0;
        for (matrix, factor) in [&linear.mass, &linear.damping, &linear.stiffness].into_iter().zip(factors) {
            for (value, x) in matrix[i].iter().zip(x) {
                sum += factor * value * x;
                terms += (factor * value * x).norm();
            }
        }
        size = size.max(terms);
        sum
    });
    (product, size)
}

fn dot(x: &[Complex], y: &[Complex]) -> Complex {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

/// An eigenvalue with its right and left vector.
struct Root {
    s: Complex,
    right: Vec<Complex>,
    left: Vec<Complex>,
    error: f64,
    condition: f64,
}

impl Root {
    fn of(mode: &Mode, change: fn(Complex) -> Complex) -> Self {
        let vector = |of: &[Complex]| of.iter().copied().map(change).collect();
        Self {
            s: change(mode.s),
            right: vector(&mode.shape),
            left: vector(mode.left()),
            error: mode.error,
            condition: mode.condition,
        }
    }
}

fn check(sizes: Sizes, random: &mut Random, rescaled: bool) {
    let mut linear = linear(sizes, random);
    let plain = modes_of(&linear, Family::General, &sizes.description()).unwrap();
    if rescaled {
        rescale(&mut linear, random);
    }
    let found = modes_of(&linear, Family::General, &sizes.description()).unwrap();
    for (a, b) in found.modes.iter().zip(&plain.modes) {
        let apart = (a.s - b.s).norm();
        assert!(apart <= 2.0 * (a.error + b.error), "{sizes:?}: {} {}: {} {}", a.s, b.s, a.error, b.error);
    }
    let conjugates = found.modes.iter().filter(|mode| mode.s.im > 0.0);
    let modes = found.modes.iter().map(|mode| Root::of(mode, |x| x));
    let all: Vec<_> = modes.chain(conjugates.map(|mode| Root::of(mode, |x| x.conj()))).collect();
    assert_eq!(all.len(), sizes.freedom(), "{sizes:?}");
    let one = Complex::new(1.0, 0.0);
    let size = |x: &[Complex]| x.iter().fold(0.0_f64, |most, x| most.max(x.norm()));
    for a in &all {
        let (rest, terms) = times(&linear, [a.s * a.s, a.s, one], &a.right);
        assert!(size(&rest) <= 1e-11 * terms, "{sizes:?}: {} of {terms}", size(&rest));
        assert!(a.error <= 1e-7 * (1.0 + a.s.norm()), "{sizes:?}: error {}", a.error);
        for b in &all {
            if a.s == b.s {
                continue;
            }
            // psi_a^T (P(s_a) - P(s_b)) / (s_a - s_b) phi_b = 0.
            let (product, _) = times(&linear, [a.s + b.s, one, Complex::default()], &b.right);
            let cross = dot(&a.left, &product).norm();
            let own = |root: &Root| {
                let factors = [2.0 * root.s, one, Complex::default()];
                dot(&root.left, &times(&linear, factors, &root.right).0).norm()
            };
            let scale = (own(a) * own(b)).sqrt() * (a.condition * b.condition).sqrt();
            assert!(cross <= 1e-8 * scale, "{sizes:?}: {} {}: {cross} of {scale}", a.s, b.s);
        }
    }
}

#[test]
fn random_pencils_have_all_their_roots() {
    let mut random = Random(11);
    let sizes = |coordinates, speeds, positions, velocities, copies| Sizes {
        coordinates,
        speeds,
        positions,
        velocities,
        copies,
    };
    for round in 0..40 {
        let rescaled = round % 2 == 1;
        check(sizes(4, 0, 2, 0, [0, 0]), &mut random, rescaled);
        check(sizes(4, 0, 3, 0, [1, 0]), &mut random, rescaled);
        check(sizes(4, 0, 0, 2, [0, 0]), &mut random, rescaled);
        check(sizes(2, 3, 0, 1, [0, 0]), &mut random, rescaled);
        check(sizes(0, 4, 0, 1, [0, 0]), &mut random, rescaled);
        check(sizes(4, 2, 1, 2, [0, 0]), &mut random, rescaled);
        check(sizes(4, 3, 2, 3, [1, 1]), &mut random, rescaled);
        check(sizes(2, 0, 0, 2, [0, 0]), &mut random, rescaled);
        check(sizes(2, 0, 2, 0, [0, 0]), &mut random, rescaled);
        check(sizes(9, 4, 3, 4, [0, 1]), &mut random, rescaled);
    }
}
