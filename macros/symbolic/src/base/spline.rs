//! Natural cubic splines: curves through points, with two continuous derivatives.
//!
//! Operators of expressions are small values that are copied and compared. The points of a curve are therefore stored
//! once and kept for the lifetime of the program, as compilers do with interned names: the same curve takes no extra
//! memory when it is used again.
//!
//! # Curves are one operation
//!
//! A curve through points is a natural cubic spline: a graph node whose derivative is a node of the same kind, one
//! order higher, or zero where the spline has no such derivative (`base/spline.rs`). Generated code passes
//! `Real::spline` a constant list of pieces, and `Real::spline` picks the piece by counting, without a branch. A call
//! is one line for a curve of any length; unrolled pieces would cost operations in proportion to the points. Straight
//! pieces beyond both ends define the equations for every argument, so solvers may look there; a physical requirement
//! rejects results there (`mechanics/checks/requirements.rs`).

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::{Mutex, PoisonError};

/// Start and coefficients of a piece: `c0 + c1 t + c2 t^2 + c3 t^3` with `t = x - start`.
pub type Piece = [f64; 5];

/// A natural cubic spline through points. It continues as a straight line before the first and after the last point, so
/// two derivatives are continuous everywhere.
#[derive(Clone, Copy)]
pub struct Spline(&'static Data);

struct Data {
    /// Names of the curve and its derivatives.
    names: [String; 4],
    pieces: Vec<Piece>,
}

static KNOWN: Mutex<Vec<&'static Data>> = Mutex::new(Vec::new());

impl Spline {
    /// The spline through at least two points with increasing arguments `x`.
    pub fn through(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::kept(name, pieces(x, y))
    }

    fn kept(name: &str, pieces: Vec<Piece>) -> Self {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |data: &&&Data| data.names[0] == name && data.pieces == pieces;
        if let Some(data) = known.iter().find(same) {
            return Self(data);
        }
        let names = ["", "_slope", "_curvature", "_third"].map(|order| format!("{name}{order}"));
        let data: &'static Data = Box::leak(Box::new(Data { names, pieces }));
        known.push(data);
        Self(data)
    }

    /// The name of the curve.
    pub fn name(self) -> &'static str {
        self.name_of(0)
    }

    /// The name of a derivative.
    pub fn name_of(self, derivative: u8) -> &'static str {
        &self.0.names[usize::from(derivative).min(3)]
    }

    /// Its pieces: the straight line before the first point, the cubics, and the straight line after the last point.
    pub fn pieces(self) -> &'static [Piece] {
        &self.0.pieces
    }

    /// Whether this derivative is zero everywhere.
    pub fn vanishes(self, derivative: u8) -> bool {
        let from = usize::from(derivative) + 1;
        let mut coefficients = self.0.pieces.iter().flat_map(|piece| piece.iter().skip(from));
        coefficients.all(|&coefficient| coefficient == 0.0)
    }

    /// The value of a derivative at `x`.
    pub fn at(self, x: f64, derivative: u8) -> f64 {
        let (t, [c0, c1, c2, c3]) = self.shifted(x);
        match derivative {
            0 => c0 + t * (c1 + t * (c2 + t * c3)),
            1 => c1 + t * (2.0 * c2 + t * (3.0 * c3)),
            2 => 2.0 * c2 + t * (6.0 * c3),
            3 => 6.0 * c3,
            _ => 0.0,
        }
    }

    /// The sum of the magnitudes of a derivative's terms, which bounds its rounding error.
    pub fn magnitude(self, x: f64, derivative: u8) -> f64 {
        let (t, c) = self.shifted(x);
        let (t, [c0, c1, c2, c3]) = (t.abs(), c.map(f64::abs));
        match derivative {
            0 => c0 + t * (c1 + t * (c2 + t * c3)),
            1 => c1 + t * (2.0 * c2 + t * (3.0 * c3)),
            2 => 2.0 * c2 + t * (6.0 * c3),
            3 => 6.0 * c3,
            _ => 0.0,
        }
    }

    /// The distance from the start of the piece at `x`, and its coefficients.
    fn shifted(self, x: f64) -> (f64, [f64; 4]) {
        let pieces = &self.0.pieces;
        let index = pieces[1..].iter().filter(|piece| x >= piece[0]).count();
        let [start, c0, c1, c2, c3] = pieces[index];
        (x - start, [c0, c1, c2, c3])
    }
}

/// Solves the three-term equations of the spline (de Boor, A Practical Guide to Splines, chapter IV) for the second
/// derivatives at the points, then builds the pieces.
fn pieces(x: &[f64], y: &[f64]) -> Vec<Piece> {
    let last = x.len() - 1;
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope: Vec<f64> = (0..last).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
    // h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (slope[i] - slope[i-1]), m = 0 at the ends
    let mut m = vec![0.0; last + 1];
    let (mut above, mut right) = (vec![0.0; last + 1], vec![0.0; last + 1]);
    for i in 1..last {
        let pivot = 2.0 * (h[i - 1] + h[i]) - h[i - 1] * above[i - 1];
        above[i] = h[i] / pivot;
        right[i] = (6.0 * (slope[i] - slope[i - 1]) - h[i - 1] * right[i - 1]) / pivot;
    }
    for i in (1..last).rev() {
        m[i] = right[i] - above[i] * m[i + 1];
    }
    let start = |i: usize| slope[i] - h[i] * (2.0 * m[i] + m[i + 1]) / 6.0;
    let end = slope[last - 1] + h[last - 1] * (m[last - 1] + 2.0 * m[last]) / 6.0;
    let mut pieces = vec![[x[0], y[0], start(0), 0.0, 0.0]];
    for i in 0..last {
        let cubic = (m[i + 1] - m[i]) / (6.0 * h[i]);
        pieces.push([x[i], y[i], start(i), m[i] / 2.0, cubic]);
    }
    pieces.push([x[last], y[last], end, 0.0, 0.0]);
    pieces
}

impl PartialEq for Spline {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl Eq for Spline {}

impl Hash for Spline {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name().hash(state);
    }
}

impl PartialOrd for Spline {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Ordered by content, not by order of creation.
impl Ord for Spline {
    fn cmp(&self, other: &Self) -> Ordering {
        let bits = |spline: &Self| -> Vec<u64> {
            spline.0.pieces.as_flattened().iter().map(|number| number.to_bits()).collect()
        };
        self.name().cmp(other.name()).then_with(|| bits(self).cmp(&bits(other)))
    }
}

impl fmt::Debug for Spline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::Spline;

    /// The spline passes through its points, has two continuous derivatives and is straight beyond the ends.
    #[test]
    fn a_spline_is_smooth() {
        let (x, y) = ([0.0, 1.0, 2.5, 3.0, 7.0], [1.0, -2.0, 4.0, 4.0, 0.5]);
        let spline = Spline::through("smooth", &x, &y);
        for (&x, &y) in x.iter().zip(&y) {
            assert!((spline.at(x, 0) - y).abs() < 1e-14);
            for derivative in 0..3 {
                let (before, after) = (spline.at(x - 1e-9, derivative), spline.at(x + 1e-9, derivative));
                assert!((before - after).abs() < 1e-6, "{x} {derivative}: {before} {after}");
            }
        }
        assert_eq!((spline.at(-1.0, 2), spline.at(9.0, 2)), (0.0, 0.0));
        assert_eq!(spline, Spline::through("smooth", &x, &y));
        assert_ne!(spline, Spline::through("other", &x, &y));
    }

    /// `x^3` up to one, then `(2 - x)^3 + 6 x - 6`: the curvature grows from zero and falls back to it. Two points give
    /// a line.
    #[test]
    fn known_splines_come_back() {
        let spline = Spline::through("hat", &[0.0, 1.0, 2.0], &[0.0, 1.0, 6.0]);
        let known = [(0.0, 0.0, 0.0), (0.5, 0.125, 0.75), (1.5, 3.125, 5.25), (2.0, 6.0, 6.0), (3.0, 12.0, 6.0)];
        for (x, value, slope) in known {
            assert!((spline.at(x, 0) - value).abs() < 1e-15, "{x}");
            assert!((spline.at(x, 1) - slope).abs() < 1e-15, "{x}");
        }
        let line = Spline::through("line", &[1.0, 3.0], &[2.0, 8.0]);
        assert_eq!((line.at(0.0, 0), line.at(2.0, 0), line.at(5.0, 0)), (-1.0, 5.0, 14.0));
        assert!(line.vanishes(2) && !line.vanishes(1) && !spline.vanishes(3));
    }
}
