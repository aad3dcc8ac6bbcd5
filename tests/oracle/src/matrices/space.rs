//! Vectors, matrices and poses in three-dimensional space.

use std::ops::{Add, Mul, Sub};

use num_dual::Dual;

use super::Scalar;

/// Three components, in a frame that the owner specifies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vector<D>(pub(crate) [D; 3]);

/// Three rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matrix<D>(pub(crate) [[D; 3]; 3]);

/// Pose of a frame in another: rotation and origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose<D> {
    pub(crate) rotation: Matrix<D>,
    pub(crate) origin: Vector<D>,
}

impl<D: Scalar> Vector<D> {
    pub(crate) fn zero() -> Self {
        Self([D::zero(); 3])
    }

    pub(crate) fn constant(components: [f64; 3]) -> Self {
        Self(components.map(D::from))
    }

    pub(crate) fn scaled(self, factor: D) -> Self {
        Self(self.0.map(|component| component * factor))
    }

    pub(crate) fn dot(self, other: Self) -> D {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }
}

impl<D: Scalar> Add for Vector<D> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<D: Scalar> Sub for Vector<D> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl<D: Scalar> Matrix<D> {
    pub(crate) fn identity() -> Self {
        Self::constant([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    }

    pub(crate) fn constant(entries: [[f64; 3]; 3]) -> Self {
        Self(entries.map(|row| row.map(D::from)))
    }

    /// `a a^T`.
    pub(crate) fn square(a: [f64; 3]) -> Self {
        Self::constant(a.map(|x| a.map(|y| x * y)))
    }

    pub(crate) fn scaled(self, factor: D) -> Self {
        Self(self.0.map(|row| row.map(|entry| entry * factor)))
    }

    /// The vector of the antisymmetric part: `[v]x = (A - A^T) / 2`.
    pub(crate) fn vee(self) -> Vector<D> {
        let part = |i: usize, j: usize| (self.0[i][j] - self.0[j][i]) * 0.5;
        Vector([part(2, 1), part(0, 2), part(1, 0)])
    }

    pub(crate) fn transpose(self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[j][i])))
    }
}

impl<D: Scalar> Add for Matrix<D> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j] + other.0[i][j])))
    }
}

impl<D: Scalar> Mul<Vector<D>> for Matrix<D> {
    type Output = Vector<D>;
    fn mul(self, vector: Vector<D>) -> Vector<D> {
        Vector(self.0.map(|row| Vector(row).dot(vector)))
    }
}

impl<D: Scalar> Mul for Matrix<D> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let columns = other.transpose().0;
        Self(self.0.map(|row| columns.map(|column| Vector(row).dot(Vector(column)))))
    }
}

impl<D: Scalar> Pose<D> {
    pub(crate) fn identity() -> Self {
        Self { rotation: Matrix::identity(), origin: Vector::zero() }
    }

    /// Transforms a position from the inner frame to the outer frame.
    pub(crate) fn point(self, position: Vector<D>) -> Vector<D> {
        self.origin + self.rotation * position
    }

    pub(crate) fn inverse(self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, origin: Vector::zero() - rotation * self.origin }
    }
}

impl<D: Scalar> Mul for Pose<D> {
    type Output = Self;
    fn mul(self, inner: Self) -> Self {
        Self { rotation: self.rotation * inner.rotation, origin: self.point(inner.origin) }
    }
}

impl<D: Scalar> Vector<Dual<D>> {
    pub(crate) fn now(self) -> Vector<D> {
        Vector(self.0.map(|component| component.re))
    }

    pub(crate) fn rate(self) -> Vector<D> {
        Vector(self.0.map(|component| component.eps))
    }
}

impl<D: Scalar> Matrix<Dual<D>> {
    pub(crate) fn now(self) -> Matrix<D> {
        Matrix(self.0.map(|row| row.map(|entry| entry.re)))
    }

    pub(crate) fn rate(self) -> Matrix<D> {
        Matrix(self.0.map(|row| row.map(|entry| entry.eps)))
    }
}

/// The unit vector along `axis`.
pub(crate) fn unit(axis: [f64; 3]) -> [f64; 3] {
    let length = axis.iter().map(|component| component * component).sum::<f64>().sqrt();
    assert!(length > 0.0, "an axis has a direction");
    axis.map(|component| component / length)
}

/// Rotation about an axis (Rodrigues): `cos a I + sin a [e]x + (1 - cos a) e e^T`.
pub(crate) fn rotation<D: Scalar>(axis: [f64; 3], angle: D) -> Matrix<D> {
    let e = unit(axis);
    let [x, y, z] = e;
    let cross = Matrix::constant([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]);
    let (sine, cosine) = (angle.sin(), angle.cos());
    Matrix::identity().scaled(cosine) + cross.scaled(sine) + Matrix::square(e).scaled(D::one() - cosine)
}
