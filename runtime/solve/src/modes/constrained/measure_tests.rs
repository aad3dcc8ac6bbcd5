//! Pairs of a bordered pencil with a closed form: three masses joined into one by two constraints of very different
//! units, `6 s^2 + 0.4 s + 15.5 = 0`.

use super::Gathered;
use super::measure::Measure;
use crate::Complex;
use crate::algebra::{Matrix, Vector};
use crate::constraints::Structure;
use crate::eigenproblem::Root;
use crate::kernels::Linear;
use crate::modes::normalisation::Normalisation;

const MOTIONS: usize = 3;
/// Units of the constraints `x = y` and `x = z`.
const UNITS: [f64; 2] = [1.0, 1e6];

fn pencil() -> Linear {
    let square = |rows: [[f64; 5]; 5]| Matrix::from_fn(5, 5, |i, j| rows[i][j]);
    let diagonal = |values: [f64; 5]| Matrix::from_fn(5, 5, |i, j| if i == j { values[i] } else { 0.0 });
    let [u, v] = UNITS;
    Linear {
        mass: diagonal([1.0, 3.0, 2.0, 0.0, 0.0]),
        damping: diagonal([0.0, 0.4, 0.0, 0.0, 0.0]),
        stiffness: square([
            [4.0, 1.0, 0.0, u, v],
            [-0.5, 9.0, 0.0, -u, 0.0],
            [0.0, 0.0, 2.0, 0.0, -v],
            [u, -u, 0.0, 0.0, 0.0],
            [v, 0.0, -v, 0.0, 0.0],
        ]),
    }
}

fn root() -> Complex {
    let real = -0.2 / 6.0;
    Complex::new(real, (15.5 / 6.0 - real * real).sqrt())
}

/// The right and left vectors of that root: everything moves together, and the reactions hold the second and third
/// mass.
fn vectors() -> [[Complex; 5]; 2] {
    let (s, one) = (root(), Complex::new(1.0, 0.0));
    let second = 3.0 * s * s + 0.4 * s;
    let third = 2.0 * s * s + 2.0;
    [8.5, 10.0].map(|stiffness| {
        let reaction = (second + stiffness) / UNITS[0];
        [one, one, one, reaction, third / UNITS[1]]
    })
}

fn measured(s: Complex, right: &[Complex], left: &[Complex]) -> Measure {
    Measure::new(&pencil(), MOTIONS, s, right, left)
}

#[test]
fn an_exact_pair_leaves_rounding() {
    let [right, left] = vectors();
    let measure = measured(root(), &right, &left);
    assert!(measure.residual < 1e-15 && measure.rounding_only, "{measure:?}");
    // What rounding of the elements can do to the root: a few units of its last digit.
    let last = f64::EPSILON * root().norm();
    assert!(measure.doubt > last && measure.doubt < 100.0 * last, "{measure:?}");
    assert!(measure.newton.norm() < measure.doubt, "{measure:?}");
}

#[test]
fn the_step_is_that_of_the_quadratic() {
    let [right, left] = vectors();
    for off in [Complex::new(1e-3, 0.0), Complex::new(-0.02, 0.05)] {
        let s = root() + off;
        let exact = (6.0 * s * s + 0.4 * s + 15.5) / (12.0 * s + 0.4);
        let measure = measured(s, &right, &left);
        assert!((measure.newton - exact).norm() < 1e-12, "{measure:?} {exact}");
    }
}

/// Whichever vector is off, and in whichever unit its constraint is written, the error must show.
#[test]
fn every_component_that_is_off_is_seen() {
    let exact = vectors();
    for side in 0..2 {
        for component in 0..MOTIONS {
            let mut both = exact;
            both[side][component] += 1e-6;
            let [right, left] = both;
            let measure = measured(root(), &right, &left);
            assert!(
                measure.residual > 1e-7 && measure.residual < 1e-5 && !measure.rounding_only,
                "{side} {component}: {measure:?}"
            );
        }
    }
}

/// An eigenvalue whose vectors vanish among all unknowns is an answer; it only has no vectors and no derivative.
#[test]
fn a_root_without_vectors_is_kept() {
    let linear = pencil();
    let [right, left] = vectors().map(|x| x.iter().copied().collect::<Vector<Complex>>());
    let zeros = Vector::zeros(5);
    let structure = Structure { coordinates: 3, speeds: 0, position_constraints: 2, velocity_constraints: 0 };
    let mut gathered = Gathered::new(&linear, structure, Normalisation::Mass);
    let root =
        Root { s: root(), right: zeros.clone(), left: zeros.clone(), residual: 0.0, error: 1e-12, condition: 1.0 };
    gathered.add(&root, false, zeros, left);
    gathered.add(&root, false, right.clone(), right);
    let [lost, found] = &gathered.roots[..] else { panic!() };
    assert!(lost.s == root.s && lost.error == root.error && lost.condition.is_infinite());
    assert!(lost.right.iter().chain(&lost.left).all(|x| x.is_finite()));
    assert!(found.right.iter().any(|x| x.norm() > 0.0));
}
