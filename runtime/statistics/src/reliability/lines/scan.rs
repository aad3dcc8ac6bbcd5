//! Every place along a line where a limit state changes its sign.

use core::cell::Cell;

/// Widths, in standard deviations, to which a place is bracketed where values are known on both sides of the limit, and
/// where they are not.
const NARROW: f64 = 1e-12;
const NARROW_JUMP: f64 = 1e-7;
/// A value may come nearer to the limit between two points than a parabola would, by this factor.
const CAUTION: f64 = 5.0;
/// A line takes at most so many times the points that it takes at first.
const MOST: usize = 6;
/// Values that differ by less than this share of themselves are one.
const ROUNDING: f64 = 1e-9;
/// Fewest intervals of a stretch.
const FEWEST_STEPS: f64 = 2.0;
/// How far a secant is moved towards the middle, relative to the square of the width.
const TOWARDS_MIDDLE: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
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
    /// Stretches of one side, in ascending order.
    pub(super) stretches: Vec<(f64, f64, Side)>,
    /// Whether any value differs from another by more than rounding.
    pub(super) moves: bool,
    /// Number of evaluations of the limit state.
    pub(super) evaluations: u64,
}

impl Scanned {
    /// Where designs fail, in ascending order.
    pub(super) fn failing(&self) -> impl Iterator<Item = Stretch> {
        self.stretches.iter().filter(|x| x.2 == Side::Fails).map(|(from, to, _)| (*from, *to))
    }

    /// Ends the present stretch where another side begins.
    fn enter(&mut self, s: f64, side: Side) {
        if let Some((_, end, _)) = self.stretches.last_mut() {
            *end = s;
        }
        self.stretches.push((s, s, side));
    }
}

/// The sides of a stretch of a line with these values: evaluated first at points of about this spacing, up to `reach` on
/// either side, beyond which nothing changes any more.
pub(super) fn scan(value: impl Fn(f64) -> f64, (from, to): Stretch, reach: f64, spacing: f64) -> Scanned {
    let (low, high) = (from.max(-reach), to.min(reach));
    if low >= high {
        return Scanned::default();
    }
    let scan = Scan { value, evaluations: Cell::new(0) };
    let steps = ((high - low) / spacing).ceil().max(FEWEST_STEPS);
    let abscissa = |k: i32| match f64::from(k) {
        k if k == steps => high,
        k => low + (high - low) * (k / steps),
    };
    let mut points: Vec<Point> = (0..=steps as i32).map(|k| scan.at(abscissa(k))).collect();
    scan.refine(&mut points);
    let first = points[0];
    let moved = |x: &Point| (x.value - first.value).abs() > ROUNDING * first.value.abs();
    let mut found =
        Scanned { moves: (points.iter()).any(|x| x.side() != first.side() || moved(x)), ..Scanned::default() };
    found.enter(from, points[0].side());
    for pair in points.windows(2) {
        scan.between(pair[0], pair[1], 0, &mut found);
    }
    if let Some((_, end, _)) = found.stretches.last_mut() {
        *end = to;
    }
    // A single point without a value has no probability.
    let point = |(from, to, side): &(f64, f64, Side)| *side == Side::WithoutValue && to - from <= 2.0 * NARROW_JUMP;
    found.stretches.retain(|stretch| !point(stretch));
    found.evaluations = scan.evaluations.get();
    found
}

impl<F: Fn(f64) -> f64> Scan<F> {
    fn at(&self, s: f64) -> Point {
        self.evaluations.set(self.evaluations.get() + 1);
        let value = (self.value)(s);
        Point { s, value }
    }

    /// Halves the intervals in which the limit may be crossed more often than their ends tell, again and again.
    fn refine(&self, points: &mut Vec<Point>) {
        let most = MOST * points.len();
        while points.len() < most {
            let open = (1..points.len()).filter(|k| may_hide(points, *k));
            let middle = |k: usize| 0.5 * (points[k - 1].s + points[k].s);
            let added: Vec<Point> = open.map(|k| self.at(middle(k))).collect();
            if added.is_empty() {
                break;
            }
            points.extend(added);
            points.sort_by(|a, b| a.s.total_cmp(&b.s));
        }
    }

    /// The changes between two points: secants, moved a little towards the middle so that both ends close in (Oliveira
    /// and Takahashi 2020, *An enhancement of the bisection method average performance*), and every third time a
    /// bisection, which makes sure of a jump.
    fn between(&self, a: Point, b: Point, depth: usize, found: &mut Scanned) {
        if a.side() == b.side() {
            return;
        }
        let width = b.s - a.s;
        let known = (a.value * b.value).is_finite() && a.value * b.value < 0.0;
        let narrow = if known { NARROW } else { NARROW_JUMP };
        let middle = a.s + 0.5 * width;
        if width <= narrow || middle <= a.s || middle >= b.s {
            found.enter(middle, b.side());
            return;
        }
        let secant = a.s + width * a.value / (a.value - b.value);
        let moved = TOWARDS_MIDDLE * width * width;
        let secant = secant + (middle - secant).clamp(-moved, moved);
        let inside = known && depth % 3 != 2 && a.s < secant && secant < b.s;
        let next = self.at(if inside { secant } else { middle });
        self.between(a, next, depth + 1, found);
        self.between(next, b, depth + 1, found);
    }
}

/// Whether the limit may be crossed, or crossed again, between point `k` and the one before it: the values bend by more
/// than is left to it; between two points on one side, only those that bend towards it count.
fn may_hide(points: &[Point], k: usize) -> bool {
    let (a, b) = (points[k - 1], points[k]);
    let (width, same) = (b.s - a.s, a.side() == b.side());
    let slope = |a: Point, b: Point| (b.value - a.value) / (b.s - a.s);
    let bend = |at: Point, [a, b, c]: [Point; 3]| {
        let second = 2.0 * (slope(b, c) - slope(a, b)) / (c.s - a.s);
        let towards = if same { at.value.signum() } else { second.signum() };
        Some(second * towards * width * width).filter(|bend| bend.is_finite())
    };
    let before = k.checked_sub(2).and_then(|j| bend(a, [points[j], a, b]));
    let after = (points.get(k + 1)).and_then(|next| bend(b, [a, b, *next]));
    let bent = before.into_iter().chain(after).fold(0.0, f64::max);
    let (first, second) = (a.value.abs(), b.value.abs());
    let left = if same { first.min(second) } else { first + second };
    width > NARROW_JUMP && CAUTION * bent > left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal::cdf;

    /// The normal probability of each side.
    struct Sides {
        fails: f64,
        without_value: f64,
        evaluations: u64,
    }

    fn sides(scanned: &Scanned) -> Sides {
        let all = |wanted: Side| {
            let stretches = scanned.stretches.iter().filter(|x| x.2 == wanted);
            let probability = |(from, to, _): &(f64, f64, Side)| match *from > 0.0 {
                true => cdf(-from) - cdf(-to),
                false => cdf(*to) - cdf(*from),
            };
            stretches.map(probability).sum()
        };
        Sides { fails: all(Side::Fails), without_value: all(Side::WithoutValue), evaluations: scanned.evaluations }
    }

    fn everywhere(value: impl Fn(f64) -> f64, steps: u32) -> Sides {
        let all = (f64::NEG_INFINITY, f64::INFINITY);
        sides(&scan(value, all, 8.0, 16.0 / f64::from(steps)))
    }

    fn fails(value: impl Fn(f64) -> f64) -> f64 {
        everywhere(value, 64).fails
    }

    fn close(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-5 * expected, "{value:e}, not {expected:e}");
    }

    #[test]
    fn planes_bands_and_jumps() {
        close(fails(|s| 3.0 - s), cdf(-3.0));
        close(fails(|s| s + 7.0), cdf(-7.0));
        close(fails(|s| (s - 1.0) * (s - 2.0)), cdf(2.0) - cdf(1.0));
        close(fails(|s| 1.0 - s * s), 2.0 * cdf(-1.0));
        let jump = |s: f64| {
            if s > 0.3 { -f64::INFINITY } else { f64::INFINITY }
        };
        close(fails(jump), cdf(-0.3));
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

    /// Two thin layers between three points of the grid, side by side, at any distance from each other.
    #[test]
    fn layers_beside_each_other_are_found() {
        for apart in [0.4, 0.1, 0.02, 4e-3] {
            for start in [0.3, 0.52, 0.7, 0.9] {
                let half = 0.1 * apart;
                let exact = |s: f64| cdf(s + half) - cdf(s - half);
                let both = exact(start) + exact(start + apart);
                let nearest = |s: f64| (s - start).abs().min((s - start - apart).abs());
                close(fails(|s| nearest(s) - half), both);
                // Peaks of two resonances.
                let peak = |s: f64| (s.powi(2) + 0.1 * half * half).sqrt().recip();
                let peaks = |s: f64| peak(s - start).max(peak(s - start - apart));
                if apart > 0.2 {
                    close(1.0 - everywhere(|s| peaks(s) - peak(half), 128).fails, both);
                }
            }
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
        assert!(line.evaluations < 33 + 50, "{}", line.evaluations);
    }

    #[test]
    fn a_crossing_takes_a_few_secants_and_a_jump_a_bisection() {
        let cost = |value: &dyn Fn(f64) -> f64| everywhere(value, 32).evaluations - 33;
        assert!(cost(&|s| 3.1 - s) <= 12);
        assert!(cost(&|s: f64| s.exp() - 9.0) <= 30);
        assert!(cost(&|s: f64| (s + 1.2).atan()) <= 14);
        let jump = |s: f64| {
            if s > 0.3 { -f64::INFINITY } else { f64::INFINITY }
        };
        assert!(cost(&jump) <= 26);
    }
}
