//! Virtual work of forces without an energy or dissipation function.

use num_dual::Dual64;

use super::Flow;
use super::expressions::{Rates, evaluate_with};
use super::poses::{Four, Poses, get, index, lift};
use crate::model::{Expr, ForceLaw, Matrix, Values};

/// `Q_i` of one coordinate: the virtual work along its displacement.
pub(super) fn along(flow: &Flow<f64>, coordinate: usize) -> f64 {
    let mut displaced = lift(&flow.position);
    displaced[coordinate].eps = 1.0;
    let work = Work {
        flow,
        coordinate,
        moving: flow.moving(),
        displaced: Poses::new(flow.model, displaced, lift(&flow.design)),
    };
    let laws = flow.model.forces.iter();
    laws.map(|force| work.of(&force.law)).sum()
}

struct Work<'a> {
    flow: &'a Flow<'a, f64>,
    coordinate: usize,
    /// Poses with their time rates.
    moving: Poses<'a, Dual64>,
    /// Poses with the virtual displacement.
    displaced: Poses<'a, Dual64>,
}

impl Work<'_> {
    fn of(&self, law: &ForceLaw) -> f64 {
        match law {
            // -T dd
            ForceLaw::Tension { from, to, tension } => {
                let distance = self.moving.distance(*from, *to);
                let tension = self.value(tension, distance);
                -tension * self.displaced.distance(*from, *to).eps
            }
            ForceLaw::Generalized { coordinate, value } => {
                let all = self.flow.model.coordinates();
                if index(&all, *coordinate) == self.coordinate { self.value(value, Dual64::from(0.0)) } else { 0.0 }
            }
            // M . dphi with M = -kr r - cr r', and F . dd with the antisymmetric parts of k and c, which have neither
            // energy nor dissipation; everything as seen in `from`
            ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } => {
                let relative = self.moving.relative(*from, *to);
                let half = |i: usize, j: usize| (relative[i][j] - relative[j][i]) * 0.5;
                let r = [half(2, 1), half(0, 2), half(1, 0)];
                let (k, c) = (self.rows(turning_stiffness), self.rows(turning_damping));
                let moment = resistance([k, c], r);
                let displaced = self.displaced.relative(*from, *to);
                let [k, c] = [stiffness, damping].map(|matrix| antisymmetric(self.rows(matrix)));
                let force = resistance([k, c], [relative[0][3], relative[1][3], relative[2][3]]);
                let displacement = [displaced[0][3].eps, displaced[1][3].eps, displaced[2][3].eps];
                dot(moment, rotation(&displaced)) + dot(force, displacement)
            }
            ForceLaw::Load { point, moment, following: false, .. } => {
                dot(self.all(moment), rotation(&self.displaced.point(*point)))
            }
            ForceLaw::Load { point, force, moment, following: true } => {
                let frame = self.displaced.point(*point);
                let turned =
                    |v: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| (0..3).map(|j| frame[i][j].re * v[j]).sum()) };
                let displacement = [frame[0][3].eps, frame[1][3].eps, frame[2][3].eps];
                dot(turned(self.all(force)), displacement) + dot(turned(self.all(moment)), rotation(&frame))
            }
            _ => 0.0,
        }
    }

    fn value(&self, expr: &Expr, length: Dual64) -> f64 {
        let rate = |coordinate| Dual64::from(self.moving.coordinate(coordinate).eps);
        let rates = Rates { of: &rate, length, length_rate: Dual64::from(length.eps) };
        evaluate_with(expr, self.flow.inputs, &self.moving, &rates).re
    }

    fn all(&self, values: &Values) -> [f64; 3] {
        values.map(|value| get(value, &self.flow.design))
    }

    fn rows(&self, matrix: &Matrix) -> [[f64; 3]; 3] {
        matrix.map(|row| self.all(&row))
    }
}

/// `-k x - c x'`.
fn resistance([k, c]: [[[f64; 3]; 3]; 2], x: [Dual64; 3]) -> [f64; 3] {
    let (values, rates) = (x.map(|x| x.re), x.map(|x| x.eps));
    std::array::from_fn(|i| -dot(k[i], values) - dot(c[i], rates))
}

/// `(A - A^T) / 2`.
fn antisymmetric(a: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (a[i][j] - a[j][i]) / 2.0))
}

/// The virtual rotation of a frame: `[dphi]x = dR R^T`.
fn rotation(frame: &Four<Dual64>) -> [f64; 3] {
    let entry = |i: usize, j: usize| -> f64 { (0..3).map(|k| frame[i][k].eps * frame[j][k].re).sum::<f64>() };
    [entry(2, 1), entry(0, 2), entry(1, 0)]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
