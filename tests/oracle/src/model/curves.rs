//! Curves through points.

use num_dual::DualNum;

use super::values::Unit;

/// A natural cubic spline, straight beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Declared name.
    pub name: String,
    /// Increasing arguments, and the value at each.
    pub points: Vec<[f64; 2]>,
    /// Units of arguments and values.
    pub units: [Unit; 2],
}

impl Curve {
    /// The value at `x`: `m0 (x1 - x)^3 / (6 h) + m1 (x - x0)^3 / (6 h) + ..` with the second derivatives `m` at
    /// the two ends of the segment.
    pub fn at<D: DualNum<Primitive = f64> + Copy>(&self, x: D) -> D {
        let (points, m) = (&self.points, self.curvatures());
        let last = points.len() - 1;
        let [first_x, first_y] = points[0];
        let [last_x, last_y] = points[last];
        let chord = |k: usize| {
            let h = points[k + 1][0] - points[k][0];
            ((points[k + 1][1] - points[k][1]) / h, h)
        };
        if x.re() < first_x {
            let (slope, h) = chord(0);
            return (x - first_x) * (slope - h * m[1] / 6.0) + first_y;
        }
        if x.re() >= last_x {
            let (slope, h) = chord(last - 1);
            return (x - last_x) * (slope + h * m[last - 1] / 6.0) + last_y;
        }
        let k = (0..last).find(|&k| x.re() < points[k + 1][0]).expect("inside the curve");
        let ([x0, y0], [x1, y1]) = (points[k], points[k + 1]);
        let h = x1 - x0;
        let (left, right) = (-x + x1, x - x0);
        left.powi(3) * (m[k] / (6.0 * h))
            + right.powi(3) * (m[k + 1] / (6.0 * h))
            + left * (y0 / h - m[k] * h / 6.0)
            + right * (y1 / h - m[k + 1] * h / 6.0)
    }

    /// Second derivatives at the points, zero at the ends. Slope continuity gives a linear system, solved by
    /// Gauss-Seidel iteration; it converges because each diagonal entry is twice the sum of the others in its row.
    fn curvatures(&self) -> Vec<f64> {
        let points = &self.points;
        let mut m = vec![0.0; points.len()];
        for _ in 0..100 {
            for k in 1..points.len() - 1 {
                let ([x0, y0], [x1, y1], [x2, y2]) = (points[k - 1], points[k], points[k + 1]);
                let (before, after) = (x1 - x0, x2 - x1);
                let turn = (y2 - y1) / after - (y1 - y0) / before;
                let neighbours = before * m[k - 1] + after * m[k + 1];
                m[k] = (6.0 * turn - neighbours) / (2.0 * (before + after));
            }
        }
        m
    }
}
