//! How a vibration moves the bodies that spin.

use super::Oracle;
use super::bodies::inertia;
use super::kinematics::{of_body, times};
use super::motion::State;
use super::space::Vector;

impl Oracle<'_> {
    /// For the vibration `Re((real + i imaginary) e^{i w t})`: the sums of `Mechanism::whirl`, with the acceleration of
    /// the centres of mass along the motion of the drives and the whole inertia tensors.
    pub fn whirl(&self, [q, u, b]: [&[f64]; 3], real: &[f64], imaginary: &[f64]) -> [f64; 7] {
        let at = self.configuration(q, &self.driven_position, b);
        let transformation = self.velocity_transformation(&at);
        let rows = 6 * at.bodies.len();
        let drive = times(&transformation.driven, &self.drives(u), rows);
        let bias = self.rest_acceleration(&State::at_rest(q, u, b));
        let moved = [real, imaginary].map(|x| times(&transformation.free, x, rows));
        let [mut moment, mut lateral, mut torsional, mut axial] = [0.0; 4];
        let [mut moving, mut still, mut energy, mut gyration] = [0.0; 4];
        let (mut place, mut spinning) = (Vector([0.0; 3]), false);
        for (body, declared) in self.model.bodies.iter().enumerate() {
            if declared.parts.is_empty() {
                continue;
            }
            let (_, omega) = of_body(&drive, body);
            let square = omega.dot(omega);
            let properties = inertia(&declared.parts, b);
            let turned = at.bodies[body].rotation;
            let tensor = turned * properties.tensor * turned.transpose();
            let mass = properties.mass;
            let half_trace = (0..3).map(|i| tensor.0[i][i]).sum::<f64>() / 2.0;
            let [r, s] = moved.each_ref().map(|list| of_body(list, body));
            if square == 0.0 {
                for (r, a) in [r, s] {
                    still += (mass * r.dot(r) + half_trace * a.dot(a)) / 2.0;
                }
                continue;
            }
            spinning = true;
            let (inward, _) = of_body(&bias, body);
            let arm = inward.scaled(-1.0 / square);
            let about_axis = omega.dot(tensor * omega) / square + mass * arm.dot(arm);
            let on_axis = [r, s].map(|(r, a)| r - a.cross(arm));
            let turns = [r.1, s.1];
            let mut share = 0.0;
            for (weight, [r, s]) in [(mass, on_axis), (half_trace, turns)] {
                moment -= weight * square.sqrt() * omega.dot(r.cross(s));
                let across = [r, s].map(|moved| omega.cross(moved));
                share += weight * across.map(|v| v.dot(v)).iter().sum::<f64>() / 2.0;
            }
            lateral += share;
            let along = |moved: [Vector<f64>; 2]| moved.map(|v| omega.dot(v).powi(2)).iter().sum::<f64>() / 2.0;
            axial += mass * along(on_axis);
            torsional += about_axis * along(turns);
            share += mass * along(on_axis) + about_axis * along(turns);
            moving += share / square;
            energy += share;
            place = place + arm.scaled(share);
            gyration += share * about_axis / mass;
        }
        if !spinning {
            return [0.0; 7];
        }
        let eccentric = match energy * gyration {
            0.0 => 0.0,
            spread => place.dot(place) / spread,
        };
        [moment, lateral, torsional, axial, eccentric, moving, still]
    }
}
