//! Reduces the bordered matrices to chosen coordinates by elimination, without using the library.

use eigentol::kernels::Linear;
use eigentol::{Description, Role};

/// A dense matrix by rows.
pub(crate) type Matrix = Vec<Vec<f64>>;

/// Mass, damping and stiffness of the chosen coordinates only.
pub(crate) struct Projected {
    pub(crate) mass: Matrix,
    pub(crate) damping: Matrix,
    pub(crate) stiffness: Matrix,
}

/// Indices of the unknowns with a given role.
fn places(description: &Description, role: Role) -> Vec<usize> {
    let all = description.coordinates.iter().enumerate();
    all.filter(|(_, info)| info.role == role).map(|(place, _)| place).collect()
}

fn part(matrix: &eigentol::Matrix, rows: &[usize], columns: &[usize]) -> Matrix {
    let row = |&i: &usize| columns.iter().map(|&j| matrix[i][j]).collect();
    rows.iter().map(row).collect()
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &[f64], j: usize| row.iter().zip(b).map(|(x, other)| x * other[j]).sum();
    a.iter().map(|row| (0..columns).map(|j| entry(row, j)).collect()).collect()
}

fn sum(a: &Matrix, b: &Matrix) -> Matrix {
    let add = |(x, y): (&Vec<f64>, &Vec<f64>)| x.iter().zip(y).map(|(x, y)| x + y).collect();
    a.iter().zip(b).map(add).collect()
}

fn transpose(a: &Matrix) -> Matrix {
    let columns = a.first().map_or(0, Vec::len);
    (0..columns).map(|j| a.iter().map(|row| row[j]).collect()).collect()
}

/// `X` with `a X = -b`, by elimination with pivoting; `a` is square and regular.
fn solve_negative(a: &Matrix, b: &Matrix) -> Matrix {
    let n = a.len();
    let mut rows: Matrix =
        a.iter().zip(b).map(|(left, right)| left.iter().copied().chain(right.iter().map(|x| -x)).collect()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).expect("rows are left");
        assert!(rows[pivot][k].abs() > 1e-12, "a singular matrix");
        rows.swap(k, pivot);
        let lead: Vec<f64> = rows[k].iter().map(|x| x / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = if i == k { 0.0 } else { row[k] };
            for (x, y) in row.iter_mut().zip(&lead) {
                *x -= factor * y;
            }
        }
        rows[k] = lead;
    }
    rows.into_iter().map(|row| row[n..].to_vec()).collect()
}

/// The equations of motion in the coordinates `kept`, whose number must equal the freedom; all others follow:
/// displacements `P y`, velocities `Z ydot + E y`, virtual velocities `Z`.
pub(crate) fn onto(linear: &Linear, description: &Description, kept: &[usize]) -> Projected {
    let q = places(description, Role::Position);
    let v = places(description, Role::Speed);
    let on_positions = places(description, Role::PositionReaction);
    let on_velocities = places(description, Role::VelocityReaction);
    let rest: Vec<usize> = q.iter().copied().filter(|i| !kept.contains(i)).collect();
    let (stiffness, damping) = (&linear.stiffness, &linear.damping);

    let follow = solve_negative(&part(stiffness, &on_positions, &rest), &part(stiffness, &on_positions, kept));
    let one = |i: usize| (0..kept.len()).map(|j| f64::from(u8::from(i == j))).collect();
    let mut displacements: Matrix = vec![Vec::new(); q.len()];
    for (row, value) in displacements.iter_mut().zip(&q) {
        let among = |list: &[usize]| list.iter().position(|other| other == value);
        *row = match (among(kept), among(&rest)) {
            (Some(i), _) => one(i),
            (_, Some(i)) => follow[i].clone(),
            _ => unreachable!("a coordinate is kept or follows"),
        };
    }
    let speeds = part(stiffness, &on_velocities, &v);
    let by_rates = product(&part(damping, &on_velocities, &q), &displacements);
    let by_positions = product(&part(stiffness, &on_velocities, &q), &displacements);
    let none = vec![vec![0.0; kept.len()]; q.len()];
    let virtual_velocities = [displacements.clone(), solve_negative(&speeds, &by_rates)].concat();
    let carried = [none, solve_negative(&speeds, &by_positions)].concat();

    // The columns of a speed hold its rate in `Chat` and the speed itself in `Khat`.
    let moving = [&q[..], &v[..]].concat();
    let beside =
        |left: Matrix, right: Matrix| -> Matrix { left.into_iter().zip(right).map(|(a, b)| [a, b].concat()).collect() };
    let inertia = beside(part(&linear.mass, &moving, &q), part(damping, &moving, &v));
    let resistance = beside(part(damping, &moving, &q), part(stiffness, &moving, &v));
    let restoring = product(&part(stiffness, &moving, &q), &displacements);
    let left = transpose(&virtual_velocities);
    let damped = sum(&product(&inertia, &carried), &product(&resistance, &virtual_velocities));
    let stiff = sum(&product(&resistance, &carried), &restoring);
    Projected {
        mass: product(&left, &product(&inertia, &virtual_velocities)),
        damping: product(&left, &damped),
        stiffness: product(&left, &stiff),
    }
}
