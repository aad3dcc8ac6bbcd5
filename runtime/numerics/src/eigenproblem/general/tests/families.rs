//! Families of pencils of any size, such as mechanisms have.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::pencils::{symmetric, uniform};
use super::{Linear, Matrix, diagonal, identity, linear, zeros};

/// `A (x) B` with a 2 x 2 matrix `B`: two directions at each place.
fn twice(a: &Matrix, b: [[f64; 2]; 2]) -> Matrix {
    let n = 2 * a.row_count();
    Matrix::from_fn(n, n, |i, j| a[i / 2][j / 2] * b[i % 2][j % 2])
}

const BOTH: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];
const TURN: [[f64; 2]; 2] = [[0.0, -1.0], [1.0, 0.0]];

fn sum(a: &Matrix, factor: f64, b: &Matrix) -> Matrix {
    Matrix::from_fn(a.row_count(), a.column_count(), |i, j| a[i][j] + factor * b[i][j])
}

fn tridiagonal(n: usize, diagonal: f64, beside: f64) -> Matrix {
    Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => diagonal,
        1 => beside,
        _ => 0.0,
    })
}

/// From absolute angles to those of joints: `T^T A T` with `T` lower triangular, all ones.
fn in_joint_angles(a: &Matrix) -> Matrix {
    let n = a.row_count();
    let mut x = a.clone();
    for i in (0..n.saturating_sub(1)).rev() {
        for j in 0..n {
            x[i][j] += x[i + 1][j];
        }
    }
    for j in (0..n.saturating_sub(1)).rev() {
        for i in 0..n {
            x[i][j] += x[i][j + 1];
        }
    }
    x
}

/// The lower triangle and its mirror image.
fn mirrored(a: &Matrix) -> Matrix {
    let n = a.row_count();
    Matrix::from_fn(n, n, |i, j| a[i.max(j)][i.min(j)])
}

/// Mass matrix of a chain of uniform bars, by absolute angles.
fn bars(n: usize, length: f64) -> Matrix {
    Matrix::from_fn(n, n, |i, j| {
        let behind = (n - 1 - i.max(j)) as f64;
        let share = if i == j { 1.0 / 3.0 } else { 0.5 };
        length * length * (behind + share)
    })
}

/// Bars hanging one from the other by universal joints under a shaft that spins at `speed`; `n` is even.
pub(crate) fn spinning_chain(n: usize, speed: f64) -> Linear {
    let bars_of = |n: usize| bars(n, 1.0);
    let mass = bars_of(n / 2);
    let weight: Vec<f64> = (0..n / 2).map(|i| 9.81 * ((n / 2 - i) as f64 - 0.5)).collect();
    let stiffness = sum(&diagonal(&weight), -speed * speed, &mass);
    let [mass, stiffness] = [mass, stiffness].map(|x| mirrored(&in_joint_angles(&x)));
    let coriolis = twice(&mass, TURN).map(|x| 2.0 * speed * x);
    linear(twice(&mass, BOTH), coriolis, twice(&stiffness, BOTH))
}

/// A row of equal rotors on one flexible beam; the coupling of neighbours and their spin.
pub(crate) fn rotors(n: usize, coupling: f64, spin: f64) -> Linear {
    let stiffness = tridiagonal(n / 2, 2.0 + 2.0 * coupling, -coupling);
    let spin = twice(&identity(n / 2), TURN).map(|x| spin * x);
    linear(identity(n), spin, twice(&stiffness, BOTH))
}

/// Two equal damped chains, as a round shaft at rest: every eigenvalue twice, with two vectors.
pub(crate) fn round_at_rest(n: usize) -> Linear {
    let stiffness = tridiagonal(n / 2, 2.0, -1.0);
    let damping =
        Matrix::from_fn(n / 2, n / 2, |i, j| 0.05 * stiffness[i][j] + if i == j && i % 3 == 0 { 0.1 } else { 0.0 });
    linear(identity(n), twice(&damping, BOTH), twice(&stiffness, BOTH))
}

/// `K = I`, `C` skew with nothing but ones.
pub(crate) fn skew_of_ones(n: usize) -> Linear {
    let ones = Matrix::from_fn(n, n, |i, j| f64::from((i > j) as i8 - (i < j) as i8));
    linear(identity(n), ones, identity(n))
}

/// Beck's column in rigid pieces under a follower load, in joint angles.
pub(crate) fn beck(n: usize, load: f64) -> Linear {
    let h = 1.0 / n as f64;
    let mass = mirrored(&in_joint_angles(&bars(n, h).map(|x| x * h)));
    // By absolute angles `load h (theta_i - theta_tip)`.
    let push = Matrix::from_fn(n, n, |i, j| {
        let delta = if i == j { 1.0 } else { 0.0 };
        let tip = if j + 1 == n { 1.0 } else { 0.0 };
        load * h * (delta - tip)
    });
    let mut springs = diagonal(&vec![1.0 / h; n]);
    springs[0][0] *= 2.0;
    let stiffness = sum(&springs, -1.0, &in_joint_angles(&push));
    linear(mass, zeros(n), stiffness)
}

/// Full random matrices: masses near one, any damping, any stiffness.
pub(crate) fn random_damped(n: usize, seed: u64) -> Linear {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut any = || Matrix::from_fn(n, n, |_, _| uniform(&mut rng));
    let (mass, damping, stiffness) = (any(), any(), any());
    let mass = sum(&identity(n), 0.2 / n as f64, &symmetric(&mass, 1.0));
    linear(mass, damping, stiffness)
}

/// Conservative: `M` and `K` positive definite, `C` skew.
pub(crate) fn random_conservative(n: usize, seed: u64) -> Linear {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut any = || Matrix::from_fn(n, n, |_, _| uniform(&mut rng));
    let (mass, damping, stiffness) = (any(), any(), any());
    let gram = |x: &Matrix, least: f64| {
        let product = |i: usize, j: usize| (0..n).map(|k| x[i][k] * x[j][k]).sum::<f64>();
        sum(&diagonal(&vec![least; n]), 1.0, &Matrix::from_fn(n, n, product))
    };
    linear(gram(&mass, 0.1), symmetric(&damping, -1.0), gram(&stiffness, 0.01))
}

/// A flexible shaft with discs, four coordinates at each node: deflections and turns in two planes. `bearings` are the
/// stiffness and damping at both ends, row by row.
pub(crate) fn shaft(
    nodes: usize,
    spin: f64,
    (bearing_stiffness, bearing_damping): ([[f64; 2]; 2], [[f64; 2]; 2]),
) -> Linear {
    let (n, l) = (4 * nodes, 1.3 / (nodes - 1) as f64);
    let (rigidity, line, turning) = (2.0e5, 30.0, 5.0e-3);
    let mut mass = zeros(n);
    let mut damping = zeros(n);
    let mut stiffness = zeros(n);
    let bend = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
    ];
    let move_ = [
        [156.0, 22.0 * l, 54.0, -13.0 * l],
        [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
        [54.0, 13.0 * l, 156.0, -22.0 * l],
        [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
    ];
    let turn = [
        [36.0, 3.0 * l, -36.0, 3.0 * l],
        [3.0 * l, 4.0 * l * l, -3.0 * l, -l * l],
        [-36.0, -3.0 * l, 36.0, -3.0 * l],
        [3.0 * l, -l * l, -3.0 * l, 4.0 * l * l],
    ];
    for element in 0..nodes - 1 {
        for (a, b) in (0..16).map(|k| (k / 4, k % 4)) {
            // Places of the two planes.
            let dof = |a: usize| 4 * (element + a / 2) + a % 2;
            let (i, j) = (dof(a), dof(b));
            let inertia = turning / (30.0 * l) * turn[a][b];
            for plane in [0, 2] {
                mass[i + plane][j + plane] += line * l / 420.0 * move_[a][b] + inertia;
                stiffness[i + plane][j + plane] += rigidity / (l * l * l) * bend[a][b];
            }
            damping[i][j + 2] += 2.0 * spin * inertia;
            damping[i + 2][j] -= 2.0 * spin * inertia;
        }
    }
    for (node, heavy, polar) in [(nodes / 4, 14.0, 0.2), (nodes / 2, 30.0, 0.4)] {
        let at = 4 * node;
        for plane in [0, 2] {
            mass[at + plane][at + plane] += heavy;
            mass[at + plane + 1][at + plane + 1] += 0.5 * polar;
        }
        damping[at + 1][at + 3] += spin * polar;
        damping[at + 3][at + 1] -= spin * polar;
    }
    for node in [0, nodes - 1] {
        for (a, b) in (0..4).map(|k| (k / 2, k % 2)) {
            stiffness[4 * node + 2 * a][4 * node + 2 * b] += bearing_stiffness[a][b];
            damping[4 * node + 2 * a][4 * node + 2 * b] += bearing_damping[a][b];
        }
    }
    linear(mass, damping, stiffness)
}

/// A shaft on isotropic springs.
pub(crate) fn undamped_shaft(nodes: usize) -> Linear {
    shaft(nodes, 300.0, ([[4e7, 0.0], [0.0, 4e7]], [[0.0; 2]; 2]))
}

/// A shaft in oil films, whose stiffness is not symmetric.
pub(crate) fn shaft_in_oil(nodes: usize) -> Linear {
    shaft(nodes, 300.0, ([[4e7, 1e7], [-3e7, 6e7]], [[2e5, 1e4], [1e4, 3e5]]))
}

/// A lightly damped, slightly circulatory chain of masses, `share` of whose springs are `ratio` times as stiff.
pub(crate) fn chain_of_masses(masses: &[f64], springs: &[f64], damping: f64) -> Linear {
    let n = masses.len();
    let mut stiffness = zeros(n);
    for (i, k) in springs.iter().enumerate() {
        stiffness[i][i] += k;
        if i > 0 {
            stiffness[i - 1][i - 1] += k;
            stiffness[i - 1][i] -= k;
            stiffness[i][i - 1] -= k;
        }
    }
    let mut rng = ChaCha8Rng::seed_from_u64(n as u64);
    let any = Matrix::from_fn(n, n, |_, _| uniform(&mut rng));
    let gyroscopic = symmetric(&any, -0.5);
    let dampers = Matrix::from_fn(n, n, |i, j| {
        let delta = if i == j { 1.0 } else { 0.0 };
        damping * (delta + gyroscopic[i][j])
    });
    linear(diagonal(masses), dampers, stiffness)
}

/// Springs over fifteen orders of magnitude.
pub(crate) fn stiff(n: usize) -> Linear {
    let springs: Vec<f64> = (0..n).map(|i| if i % 2 == 1 { 10f64.powi((i * 15 / n) as i32) } else { 1.0 }).collect();
    chain_of_masses(&vec![1.0; n], &springs, 0.1)
}

/// Every fourth mass is as good as nothing.
pub(crate) fn nearly_massless(n: usize) -> Linear {
    let masses: Vec<f64> = (0..n).map(|i| if i % 4 == 3 { 1e-12 } else { 1.0 }).collect();
    chain_of_masses(&masses, &vec![1.0; n], 0.05)
}

/// Uncoupled in the coordinates of a random matrix with small integers: `m s^2 + c s + k` each.
pub(crate) fn hidden(quadratics: &[[f64; 3]], seed: u64) -> Linear {
    let n = quadratics.len();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let coupling = Matrix::from_fn(n, n, |i, j| {
        let delta = if i == j { 1.0 } else { 0.0 };
        delta + 0.5 / (n as f64).sqrt() * uniform(&mut rng)
    });
    let seen = |part: usize| {
        Matrix::from_fn(n, n, |i, j| (0..n).map(|k| coupling[k][i] * quadratics[k][part] * coupling[k][j]).sum::<f64>())
    };
    linear(seen(0), seen(1), seen(2))
}

/// Modes that are all damped critically: pairs of equal eigenvalues with one vector each.
pub(crate) fn critically_damped(n: usize) -> Linear {
    let of = |i: usize| {
        let rate = 1.0 + i as f64 / n as f64;
        [1.0, 2.0 * rate, rate * rate]
    };
    hidden(&(0..n).map(of).collect::<Vec<_>>(), 1)
}

/// Overdamped by up to 1e4.
pub(crate) fn overdamped(n: usize) -> Linear {
    let of = |i: usize| [1.0, 10f64.powf(4.0 * i as f64 / n as f64) + 2.0, 1.0];
    hidden(&(0..n).map(of).collect::<Vec<_>>(), 2)
}

/// `s^2 = -k` with one chain of `n` vectors.
pub(crate) fn jordan(n: usize, k: f64) -> Linear {
    let stiffness = Matrix::from_fn(n, n, |i, j| match (i, j) {
        _ if i == j => k,
        _ if j == i + 1 => 1.0,
        _ => 0.0,
    });
    linear(identity(n), zeros(n), stiffness)
}
