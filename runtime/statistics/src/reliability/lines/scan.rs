//! Every place along a line where a limit state changes its sign.

use core::cell::Cell;

use super::line::Line;
use crate::normal::cdf;

/// Widths, in standard deviations, to which a place is bracketed where values are known on both sides of the limit, and
/// where they are not.
const NARROW: f64 = 1e-12;
const NARROW_JUMP: f64 = 1e-7;
/// A value that changes by less than this share of itself next to an extremum does not reach zero there.
const FLAT: f64 = 0.2;
/// Fewest intervals of a stretch.
const FEWEST_STEPS: f64 = 2.0;
/// Maximum number of steps towards an extremum.
const STEPS: usize = 60;
/// How far a secant is moved towards the middle, relative to the square of the width.
const TOWARDS_MIDDLE: f64 = 0.1;
/// `(3 - sqrt(5)) / 2`.
const GOLDEN: f64 = 0.381_966_011_250_105;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Safe,
    Fails,
    WithoutValue,
}

/// A point of the line and the value of the limit state there; NaN if there is none.
#[derive(Clone, Copy, Debug)]
struct Point {
    s: f64,
    value: f64,
}

impl Point {
    fn side(&self) -> Side {
        match self.value {
            value if value.is_nan() => Side::WithoutValue,
            value if value > 0.0 => Side::Safe,
            _ => Side::Fails,
        }
    }
}

struct Scan<F> {
    value: F,
    evaluations: Cell<u64>,
}

/// A part of a line, from one distance along it to another; either may be infinite.
pub(super) type Stretch = (f64, f64);

/// What a scan finds.
#[derive(Debug, Default)]
pub(super) struct Scanned {
    pub(super) line: Line,
    /// Where designs fail, in ascending order.
    pub(super) failing: Vec<Stretch>,
}

/// The probabilities along a stretch of a line with these values: evaluated first at points of about this spacing, up to
/// `reach` on either side, beyond which nothing changes any more.
pub(super) fn scan(
    value: impl Fn(f64) -> f64,
    (from, to): Stretch,
    reach: f64,
    spacing: f64,
) -> Scanned {
    let (low, high) = (from.max(-reach), to.min(reach));
    if low >= high {
        return Scanned::default();
    }
    let scan = Scan {
        value,
        evaluations: Cell::new(0),
    };
    let steps = ((high - low) / spacing).ceil().max(FEWEST_STEPS);
    let abscissa = |k: i32| match f64::from(k) {
        k if k == steps => high,
        k => low + (high - low) * (k / steps),
    };
    // An end within reach takes a point beyond it, so that what is hidden in the last interval has a neighbour.
    let (first, last) = (-i32::from(from > -reach), i32::from(to < reach));
    let grid: Vec<Point> = (first..=steps as i32 + last)
        .map(|k| scan.at(abscissa(k)))
        .collect();
    let mut points = Vec::with_capacity(grid.len());
    for (k, point) in grid.iter().enumerate() {
        points.push(*point);
        if let (Some(before), Some(after)) = (k.checked_sub(1), grid.get(k + 1)) {
            points.extend(scan.hidden([grid[before], *point, *after]));
        }
    }
    points.retain(|point| (low..=high).contains(&point.s));
    points.sort_by(|a, b| a.s.total_cmp(&b.s));
    let mut stretches = Stretches::from(from, points[0].side());
    for pair in points.windows(2) {
        scan.between(pair[0], pair[1], 0, &mut stretches);
    }
    stretches.enter(to, Side::Safe);
    stretches.found.line.evaluations = scan.evaluations.get();
    stretches.found
}

impl<F: Fn(f64) -> f64> Scan<F> {
    fn at(&self, s: f64) -> Point {
        self.evaluations.set(self.evaluations.get() + 1);
        let value = (self.value)(s);
        Point { s, value }
    }

    /// A point on the other side of the limit between three points, of which the middle one is nearest to the limit: by
    /// golden section towards it.
    fn hidden(&self, [mut a, mut b, mut c]: [Point; 3]) -> Option<Point> {
        let side = b.side();
        let size = |point: &Point| point.value.abs();
        let nearest = a.side() == side
            && c.side() == side
            && size(&c).is_finite()
            && size(&a).is_finite()
            && size(&b) < size(&a)
            && size(&b) <= size(&c);
        if !nearest {
            return None;
        }
        for _ in 0..STEPS {
            if size(&a).max(size(&c)) - size(&b) <= FLAT * size(&b) || c.s - a.s <= NARROW {
                return None;
            }
            let left = b.s - a.s > c.s - b.s;
            let s = match left {
                true => b.s - GOLDEN * (b.s - a.s),
                false => b.s + GOLDEN * (c.s - b.s),
            };
            let next = self.at(s);
            if next.side() != side {
                return Some(next);
            }
            match (left, size(&next) < size(&b)) {
                (true, true) => (b, c) = (next, b),
                (true, false) => a = next,
                (false, true) => (a, b) = (b, next),
                (false, false) => c = next,
            }
        }
        None
    }

    /// The changes between two points: secants, moved a little towards the middle so that both ends close in (Oliveira
    /// and Takahashi 2020, *An enhancement of the bisection method average performance*), and every third time a
    /// bisection, which makes sure of a jump.
    fn between(&self, a: Point, b: Point, depth: usize, stretches: &mut Stretches) {
        if a.side() == b.side() {
            return;
        }
        let width = b.s - a.s;
        let known = (a.value * b.value).is_finite() && a.value * b.value < 0.0;
        let narrow = if known { NARROW } else { NARROW_JUMP };
        let middle = a.s + 0.5 * width;
        if width <= narrow || middle <= a.s || middle >= b.s {
            stretches.enter(middle, b.side());
            return;
        }
        let secant = a.s + width * a.value / (a.value - b.value);
        let moved = TOWARDS_MIDDLE * width * width;
        let secant = secant + (middle - secant).clamp(-moved, moved);
        let inside = known && depth % 3 != 2 && a.s < secant && secant < b.s;
        let next = self.at(if inside { secant } else { middle });
        self.between(a, next, depth + 1, stretches);
        self.between(next, b, depth + 1, stretches);
    }
}

/// The probability of each side, summed along the line.
struct Stretches {
    start: f64,
    side: Side,
    found: Scanned,
}

impl Stretches {
    fn from(start: f64, side: Side) -> Self {
        Self {
            start,
            side,
            found: Scanned::default(),
        }
    }

    /// Ends the present stretch where another side begins.
    fn enter(&mut self, s: f64, side: Side) {
        let probability = match self.start > 0.0 {
            true => cdf(-self.start) - cdf(-s),
            false => cdf(s) - cdf(self.start),
        };
        let Scanned { line, failing } = &mut self.found;
        match self.side {
            Side::Safe => {}
            Side::Fails => {
                line.fails += probability;
                failing.push((self.start, s));
            }
            Side::WithoutValue => line.without_value += probability,
        }
        (self.start, self.side) = (s, side);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn everywhere(value: impl Fn(f64) -> f64, steps: u32) -> Line {
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        scan(value, all, 8.0, 16.0 / f64::from(steps)).line
    }

    fn fails(value: impl Fn(f64) -> f64) -> f64 {
        everywhere(value, 64).fails
    }

    fn close(value: f64, expected: f64) {
        assert!(
            (value - expected).abs() <= 1e-5 * expected,
            "{value:e}, not {expected:e}"
        );
    }

    #[test]
    fn planes_bands_and_jumps() {
        close(fails(|s| 3.0 - s), cdf(-3.0));
        close(fails(|s| s + 7.0), cdf(-7.0));
        close(fails(|s| (s - 1.0) * (s - 2.0)), cdf(2.0) - cdf(1.0));
        close(fails(|s| 1.0 - s * s), 2.0 * cdf(-1.0));
        let jump = |s: f64| {
            if s > 0.3 {
                -f64::INFINITY
            } else {
                f64::INFINITY
            }
        };
        close(fails(jump), cdf(-0.3));
    }

    /// A thin layer next to an end of a stretch, where no inner point is nearest to it.
    #[test]
    fn layers_next_to_an_end() {
        for (from, to) in [(1.0, 4.0), (1.0, f64::INFINITY), (1.0, 1.4)] {
            for centre in [1.001, 1.04, 1.2] {
                let layer = |s: f64| (s - centre).abs() - 1e-5;
                let fails = scan(layer, (from, to), 8.0, 0.5).line.fails;
                close(fails, cdf(centre + 1e-5) - cdf(centre - 1e-5));
                let mirrored = scan(|s| layer(-s), (-to, -from), 8.0, 0.5).line.fails;
                close(mirrored, fails);
            }
        }
    }

    /// Layers of failure far thinner than the grid: round, pointed and cusped.
    #[test]
    fn thin_layers_are_found() {
        for half in [1e-2, 1e-4, 1e-6] {
            let exact = cdf(-1.3 + half) - cdf(-1.3 - half);
            close(fails(|s| (s + 1.3).powi(2) - half * half), exact);
            close(fails(|s| (s + 1.3).abs() - half), exact);
            let cusp = |s: f64| (s + 1.3).abs().sqrt() - half.sqrt();
            close(fails(cusp), exact);
            // A layer of safety in failure.
            close(1.0 - fails(|s| half - (s + 1.3).abs()), exact);
        }
    }

    #[test]
    fn what_has_no_value_is_counted_apart() {
        let value = |s: f64| match s {
            s if s < -2.0 => f64::NAN,
            s => s + 1.0,
        };
        let line = everywhere(value, 32);
        let of = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-5);
        of(line.without_value, cdf(-2.0));
        of(line.fails, cdf(-1.0) - cdf(-2.0));
        // A window without a value between safety and failure.
        let value = |s: f64| match s {
            s if (1.0..1.1).contains(&s) => f64::NAN,
            s => 1.05 - s,
        };
        let line = everywhere(value, 32);
        of(line.without_value, cdf(1.1) - cdf(1.0));
        of(line.fails, cdf(-1.1));
    }

    #[test]
    fn a_value_that_stays_above_zero_costs_little() {
        let line = everywhere(|s| 1e-3 + (s - 0.1).powi(2), 32);
        assert_eq!(line.fails, 0.0);
        assert!(line.evaluations < 33 + 25, "{}", line.evaluations);
    }

    #[test]
    fn a_crossing_takes_a_few_secants_and_a_jump_a_bisection() {
        let cost = |value: &dyn Fn(f64) -> f64| everywhere(value, 32).evaluations - 33;
        assert!(cost(&|s| 3.1 - s) <= 12);
        assert!(cost(&|s: f64| s.exp() - 9.0) <= 14);
        assert!(cost(&|s: f64| (s + 1.2).atan()) <= 14);
        let jump = |s: f64| {
            if s > 0.3 {
                -f64::INFINITY
            } else {
                f64::INFINITY
            }
        };
        assert!(cost(&jump) <= 26);
    }
}
