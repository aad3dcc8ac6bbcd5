use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::{Rows, Structure, Tangent, fix_gauge};
use crate::algebra::{Lu, Matrix, Vector, add_scaled, dot, largest, times};
use crate::kernels::Linear;

fn uniform(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Four rows of six columns, in units 1e6 apart; the third is twice the first minus the second.
fn rows(random: &mut ChaCha8Rng) -> Matrix {
    let units = [1.0, 1e-3, 1e3, 1.0, 1e-2, 1e3];
    let mut rows = [[0.0; 6]; 4];
    for k in [0, 1, 3] {
        rows[k] = units.map(|unit| unit * uniform(random));
    }
    rows[2] = core::array::from_fn(|j| 2.0 * rows[0][j] - rows[1][j]);
    rows[1] = rows[1].map(|value| 1e5 * value);
    Matrix::from(rows)
}

#[test]
fn rank_null_space_and_dependencies() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..50 {
        let given = rows(&mut random);
        let rows = Rows::balanced(given.clone());
        assert_eq!((rows.rank, rows.dependent()), (3, 1));
        let n = rows.null_left(0);
        let expected = [2.0, -1e-5, -1.0, 0.0];
        let factor = n[0] / expected[0];
        for (have, want) in n.iter().zip(expected) {
            assert!((have - factor * want).abs() <= 1e-12 * factor.abs());
        }
        assert!((dot(&n, &rows.null_left_scaled(0)) - 1.0).abs() < 1e-13);
        assert_eq!(rows.null_basis(6).len(), 3);
        for direction in &rows.null_basis(6) {
            for row in given.iter() {
                let terms: f64 = row.iter().zip(direction).map(|(a, b)| (a * b).abs()).sum();
                assert!(dot(row, direction).abs() <= 1e-13 * terms);
            }
        }
        let x = Vector::from_fn(6, |_| uniform(&mut random));
        let right = times(&given, &x);
        let back = times(&given, &rows.shortest(&right));
        assert!((0..4).all(|k| (back[k] - right[k]).abs() <= 1e-12 * right[k].abs().max(1.0)));
    }
}

#[test]
fn multipliers_balance_what_can_be_balanced() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let given = rows(&mut random);
    let rows = Rows::balanced(given.clone());
    let mu = [0.3, -2e-5, 0.7, 1.5];
    let force = times(&given.transpose(), &mu);
    let again = rows.multipliers(&force);
    let balanced = times(&given.transpose(), &again);
    assert!((0..6).all(|j| (balanced[j] - force[j]).abs() <= 1e-12 * force[j].abs()));
    assert!(dot(&again, &rows.null_left_scaled(0)).abs() <= 1e-12);
}

/// Three coordinates (two metres, one radian) and three constraints, two of which are equivalent in different units.
fn bordered() -> (Linear, Structure) {
    let h = [[1.0, 2.0, 0.5], [1e3, 2e3, 5e2], [0.0, 1.0, -0.1]];
    let mut linear = Linear::zeros(6);
    for i in 0..3 {
        linear.mass[i][i] = [2.0, 3.0, 1e-2][i];
        for j in 0..3 {
            linear.stiffness[i][j] = [[900.0, 20.0, 5.0], [20.0, 400.0, -3.0], [5.0, -3.0, 7.0]][i][j];
            linear.stiffness[3 + i][j] = h[i][j];
            linear.stiffness[j][3 + i] = h[i][j];
        }
    }
    let structure = Structure { coordinates: 3, speeds: 0, position_constraints: 3, velocity_constraints: 0 };
    (linear, structure)
}

#[test]
fn a_gauge_makes_redundant_constraints_regular_and_moves_nothing() {
    let (linear, structure) = bordered();
    assert!(Lu::new(&linear.stiffness).is_none());
    let mut fixed = linear.stiffness.clone();
    fix_gauge(&mut fixed, structure);
    let lu = Lu::new(&fixed).expect("regular");
    let force = [1.0, -2.0, 0.3, 0.0, 0.0, 0.0];
    let x = lu.solve(&force);
    let rest = add_scaled(&times(&linear.stiffness, &x), -1.0, &force);
    assert!(largest(&rest) < 1e-12, "{rest:?}");
    // The same rows, without the repeated one.
    let kept = [0, 1, 2, 3, 5];
    let single = Matrix::from_fn(5, 5, |i, j| linear.stiffness[kept[i]][kept[j]]);
    let once = Lu::new(&single).expect("regular").solve(&[1.0, -2.0, 0.3, 0.0, 0.0]);
    assert!((0..3).all(|i| (x[i] - once[i]).abs() < 1e-13));
    assert!((x[3] + 1e3 * x[4] - once[3]).abs() < 1e-10 * once[3].abs());
}

#[test]
fn reduction_has_the_stiffness_and_mass_of_the_free_direction() {
    let (linear, structure) = bordered();
    let tangent = Tangent::new(&linear, structure);
    assert_eq!((tangent.freedom, tangent.redundant()), (1, 1));
    // x + 2 y + 0.5 t = 0, y = 0.1 t: along t.
    let along = [-0.7, 0.1, 1.0, 0.0, 0.0, 0.0];
    let reduced = tangent.reduce_linear(&linear);
    let mass = dot(&along, &times(&linear.mass, &along));
    let stiffness = dot(&along, &times(&linear.stiffness, &along));
    let lambda = reduced.stiffness[0][0] / reduced.mass[0][0];
    assert!((lambda - stiffness / mass).abs() < 1e-12 * lambda.abs());
    assert_eq!(reduced.mass.row_count(), 1);
}
