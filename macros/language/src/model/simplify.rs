//! Building expressions: numbers are combined immediately, so that constant values are recognised.

use std::rc::Rc;

use super::expression::{Expr, Function, Matrix, Vector};

use Expr::Number;

/// `-a`.
pub(super) fn negate(a: Expr) -> Expr {
    match a {
        Number(0.0) => Number(0.0),
        Number(a) => Number(-a),
        Expr::Negate(inner) => (*inner).clone(),
        a => Expr::Negate(Rc::new(a)),
    }
}

/// `a + b`.
pub(super) fn add(a: Expr, b: Expr) -> Expr {
    match (a, b) {
        (Number(a), Number(b)) => Number(a + b),
        (Number(0.0), other) | (other, Number(0.0)) => other,
        (a, b) => Expr::Add(Rc::new(a), Rc::new(b)),
    }
}

/// `a - b`.
pub(super) fn subtract(a: Expr, b: Expr) -> Expr {
    match (a, b) {
        (Number(a), Number(b)) => Number(a - b),
        (a, Number(0.0)) => a,
        (Number(0.0), b) => negate(b),
        (a, b) => Expr::Subtract(Rc::new(a), Rc::new(b)),
    }
}

/// `a * b`.
pub(super) fn multiply(a: Expr, b: Expr) -> Expr {
    match (a, b) {
        (Number(a), Number(b)) => Number(a * b),
        (Number(0.0), _) | (_, Number(0.0)) => Number(0.0),
        (Number(1.0), other) | (other, Number(1.0)) => other,
        (Number(-1.0), other) | (other, Number(-1.0)) => negate(other),
        (a, b) => Expr::Multiply(Rc::new(a), Rc::new(b)),
    }
}

/// `a / b`.
pub(super) fn divide(a: Expr, b: Expr) -> Expr {
    match (a, b) {
        (Number(a), Number(b)) => Number(a / b),
        (Number(0.0), _) => Number(0.0),
        (a, Number(1.0)) => a,
        (a, b) => Expr::Divide(Rc::new(a), Rc::new(b)),
    }
}

/// `a ^ n`.
pub(super) fn power_integer(a: Expr, n: i32) -> Expr {
    match (a, n) {
        (_, 0) => Number(1.0),
        (a, 1) => a,
        (Number(a), n) => Number(a.powi(n)),
        (a, n) => Expr::PowerInteger(Rc::new(a), n),
    }
}

/// `a ^ b`.
pub(super) fn power(a: Expr, b: Expr) -> Expr {
    match (a, b) {
        (Number(a), Number(b)) => Number(a.powf(b)),
        (a, Number(0.5)) => call(Function::Sqrt, a),
        (a, b) => Expr::Power(Rc::new(a), Rc::new(b)),
    }
}

/// `f(a)`.
pub(super) fn call(function: Function, a: Expr) -> Expr {
    match a {
        Number(a) => Number(function.apply(a)),
        a => Expr::Call(function, Rc::new(a)),
    }
}

/// `atan2(y, x)`.
pub(super) fn atan2(y: Expr, x: Expr) -> Expr {
    match (y, x) {
        (Number(y), Number(x)) => Number(y.atan2(x)),
        (y, x) => Expr::Atan2(Rc::new(y), Rc::new(x)),
    }
}

/// Applies `f` to the components of two vectors.
pub(super) fn componentwise(a: Vector, b: Vector, f: impl Fn(Expr, Expr) -> Expr) -> Vector {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    [f(ax, bx), f(ay, by), f(az, bz)]
}

/// Applies `f` to the entries of two matrices.
pub(super) fn entrywise(a: Matrix, b: Matrix, f: impl Fn(Expr, Expr) -> Expr) -> Matrix {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    [(ax, bx), (ay, by), (az, bz)].map(|(a, b)| componentwise(a, b, &f))
}

/// Scalar product.
pub(super) fn dot(a: &Vector, b: &Vector) -> Expr {
    let [x, y, z] = componentwise(a.clone(), b.clone(), multiply);
    add(add(x, y), z)
}

/// Euclidean length. The square of a component is written as a power, so that it is known to be non-negative.
pub(super) fn norm(a: &Vector) -> Expr {
    let [x, y, z] = a.clone().map(|component| power_integer(component, 2));
    call(Function::Sqrt, add(add(x, y), z))
}

/// Vector product.
pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    let entry =
        |i: usize, j: usize| subtract(multiply(a[i].clone(), b[j].clone()), multiply(a[j].clone(), b[i].clone()));
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

/// The angle between two vectors, from 0 to pi: `atan2(|a x b|, a . b)`, accurate near 0 and pi where an arc cosine is
/// not.
pub(super) fn angle(a: &Vector, b: &Vector) -> Expr {
    atan2(norm(&cross(a, b)), dot(a, b))
}

/// The matrix with this diagonal and zeros elsewhere.
pub(super) fn diagonal(entries: Vector) -> Matrix {
    let mut matrix = [(); 3].map(|()| [0.0; 3].map(Number));
    for (i, entry) in entries.into_iter().enumerate() {
        matrix[i][i] = entry;
    }
    matrix
}

/// The diagonal of a matrix whose other entries are zero.
pub(super) fn diagonal_of(matrix: &Matrix) -> Option<Vector> {
    let entries = std::array::from_fn(|i| matrix[i][i].clone());
    (diagonal(entries) == *matrix).then(|| std::array::from_fn(|i| matrix[i][i].clone()))
}
