//! Frames, and moments of mass relative to them.

pub(crate) type Vector = [f64; 3];
/// A matrix by rows.
pub(crate) type Matrix = [Vector; 3];

pub(crate) fn matrix(entry: impl Fn(usize, usize) -> f64) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

fn identity(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    matrix(|i, j| (0..3).map(|k| a[i][k] * b[k][j]).sum())
}

fn turned(a: &Matrix, v: Vector) -> Vector {
    [0, 1, 2].map(|i| (0..3).map(|k| a[i][k] * v[k]).sum())
}

pub(crate) fn norm(v: Vector) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

pub(crate) fn cross([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// `cos 1 + sin [a]x + (1 - cos) a a^T` (Rodrigues).
fn rotation(axis: Vector, angle: f64) -> Matrix {
    let length = norm(axis);
    let a = axis.map(|x| x / length);
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = a;
    let skew = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    matrix(|i, j| cos * identity(i, j) + sin * skew[i][j] + (1.0 - cos) * a[i] * a[j])
}

/// Pose of a frame in another: `xyz`, then rotations, each about the axes left by the previous one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Pose {
    /// m.
    pub(crate) offset: Vector,
    /// Axis and angle in rad.
    pub(crate) rotations: Vec<(Vector, f64)>,
}

/// Mass and inertia, about the centre of mass and in the axes of `pose`.
#[derive(Clone, Debug)]
pub(crate) struct Inertial {
    pub(crate) pose: Pose,
    /// kg.
    pub(crate) mass: f64,
    /// kg m^2.
    pub(crate) inertia: Matrix,
}

impl Pose {
    /// The axes of the frame, as columns.
    pub(crate) fn matrix(&self) -> Matrix {
        let turns = self.rotations.iter();
        turns.fold(matrix(identity), |before, &(axis, angle)| product(&before, &rotation(axis, angle)))
    }

    /// The pose of the outer frame in this one.
    pub(crate) fn inverse(&self) -> Pose {
        let rotations: Vec<_> = self.rotations.iter().rev().map(|&(axis, angle)| (axis, -angle)).collect();
        let back = Pose { offset: [0.0; 3], rotations: rotations.clone() };
        Pose { offset: turned(&back.matrix(), self.offset).map(|x| -x), rotations }
    }

    /// This pose followed by `inner`, which is a pose in the frame that this one describes.
    pub(crate) fn then(&self, inner: &Pose) -> Pose {
        let offset = turned(&self.matrix(), inner.offset);
        Pose {
            offset: [0, 1, 2].map(|i| match offset[i] {
                0.0 => self.offset[i],
                further => self.offset[i] + further,
            }),
            rotations: [&self.rotations[..], &inner.rotations].concat(),
        }
    }
}

/// The integrals of 1, `r` and `r r^T` over mass.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    pub(crate) mass: f64,
    first: Vector,
    second: Matrix,
}

impl Moments {
    /// The moments of a link placed at `pose`.
    pub(crate) fn of(inertial: &Inertial, pose: &Pose) -> Self {
        let frame = pose.then(&inertial.pose);
        let turn = frame.matrix();
        let mass = inertial.mass;
        let half = (0..3).map(|k| inertial.inertia[k][k]).sum::<f64>() / 2.0;
        let local = matrix(|i, j| half * identity(i, j) - inertial.inertia[i][j]);
        let back = matrix(|i, j| turn[j][i]);
        let central = product(&product(&turn, &local), &back);
        let center = frame.offset;
        Self {
            mass,
            first: center.map(|x| mass * x),
            second: matrix(|i, j| central[i][j] + mass * center[i] * center[j]),
        }
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        for i in 0..3 {
            self.first[i] += other.first[i];
            for j in 0..3 {
                self.second[i][j] += other.second[i][j];
            }
        }
    }

    /// Centre of mass, and the inertia about it.
    pub(crate) fn central(&self) -> (Vector, Matrix) {
        let center = self.first.map(|first| first / self.mass);
        let second = matrix(|i, j| self.second[i][j] - self.mass * center[i] * center[j]);
        let trace: f64 = (0..3).map(|k| second[k][k]).sum();
        (center, matrix(|i, j| trace * identity(i, j) - second[i][j]))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    /// `R = Rz(yaw) Ry(pitch) Rx(roll)`: a turn by 90 degrees about z takes x to y.
    #[test]
    fn poses_follow_each_other() {
        let turn = Pose {
            offset: [1.0, 2.0, 3.0],
            rotations: vec![([0.0, 0.0, 1.0], FRAC_PI_2), ([1.0, 0.0, 0.0], FRAC_PI_2)],
        };
        let [x, y, z] = turn.matrix();
        for (row, expected) in [x, y, z].into_iter().zip([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]) {
            for (a, b) in row.into_iter().zip(expected) {
                assert!((a - b).abs() < 1e-15, "{row:?}");
            }
        }
        let twice = turn.then(&turn);
        let offset = [1.0 + 3.0, 2.0 + 1.0, 3.0 + 2.0];
        for (a, b) in twice.offset.into_iter().zip(offset) {
            assert!((a - b).abs() < 1e-15, "{:?}", twice.offset);
        }
    }

    /// Two halves of a rod of 6 kg and 2 m give `m l^2 / 12` about its middle.
    #[test]
    fn halves_make_a_rod() {
        let third = 3.0 / 12.0;
        let half = Inertial {
            pose: Pose { offset: [0.5, 0.0, 0.0], rotations: vec![([0.0, 0.0, 1.0], FRAC_PI_2)] },
            mass: 3.0,
            inertia: [[third, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, third]],
        };
        let mut rod = Moments::of(&half, &Pose::default());
        let mirrored = Pose { offset: [2.0, 0.0, 0.0], rotations: vec![([0.0, 1.0, 0.0], 2.0 * FRAC_PI_2)] };
        rod.add(&Moments::of(&half, &mirrored));
        let (center, inertia) = rod.central();
        for (i, row) in inertia.into_iter().enumerate() {
            for (j, entry) in row.into_iter().enumerate() {
                let expected = if i == j && i > 0 { 2.0 } else { 0.0 };
                assert!((entry - expected).abs() < 1e-14, "{inertia:?}");
            }
        }
        assert!((center[0] - 1.0).abs() < 1e-15);
    }
}
