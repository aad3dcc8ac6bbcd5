//! The whirl sense of a vibration.

use super::Oracle;
use super::bodies::inertia;
use super::kinematics::times;
use super::space::Vector;

impl Oracle<'_> {
    /// For the vibration `Re((real + i imaginary) e^{i w t})`, the sums over all bodies of
    /// `-|o| o . (m r x s + k a x b)` and `(m (|o x r|^2 + |o x s|^2) + k (|o x a|^2 + |o x b|^2)) / 2`, where `o` is
    /// the angular velocity at rest, `r` and `s` are the displacements of the centre of mass, `a` and `b` the
    /// rotations, and `k` is half the trace of the inertia tensor.
    pub fn whirl(&self, [q, u, b]: [&[f64]; 3], real: &[f64], imaginary: &[f64]) -> [f64; 2] {
        let at = self.configuration(q, &self.driven_position, b);
        let transformation = self.velocity_transformation(&at);
        let rows = 6 * at.bodies.len();
        let drive = times(&transformation.driven, &self.drives(u), rows);
        let [real, imaginary] = [real, imaginary].map(|x| times(&transformation.free, x, rows));
        let vector = |list: &[f64], row: usize| Vector([list[row], list[row + 1], list[row + 2]]);
        let (mut moment, mut size) = (0.0, 0.0);
        for (body, declared) in self.model.bodies.iter().enumerate() {
            let omega = vector(&drive, 6 * body + 3);
            let speed = omega.dot(omega).sqrt();
            let properties = inertia(&declared.parts, b);
            let [x, y, z] = [0, 1, 2].map(|i| properties.tensor.0[i][i]);
            for (row, weight) in [(0, properties.mass), (3, (x + y + z) / 2.0)] {
                let [r, s] = [&real, &imaginary].map(|list| vector(list, 6 * body + row));
                moment -= weight * speed * omega.dot(r.cross(s));
                let across = [r, s].map(|moved| omega.cross(moved));
                size += weight * across.map(|v| v.dot(v)).iter().sum::<f64>() / 2.0;
            }
        }
        [moment, size]
    }
}
