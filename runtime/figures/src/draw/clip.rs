//! Clipping of curves and bands at the edges of the panel.

use crate::figure::Point;

/// The parts of a curve within the ranges of a panel, with new end points on its edges.
pub(super) fn clip(curve: &[Point], x: [f64; 2], y: [f64; 2]) -> Vec<Vec<Point>> {
    let turned = |piece: Vec<Point>| -> Vec<Point> { piece.into_iter().map(|[x, y]| [y, x]).collect() };
    let within = within(curve, y);
    within.into_iter().map(turned).flat_map(|part| self::within(&part, x)).map(turned).collect()
}

/// The part of a band within a range, with its edges cut at the ends of the range.
pub(super) fn clip_band(edges: &[[f64; 3]], [left, right]: [f64; 2]) -> Vec<[f64; 3]> {
    let inside = |edge: &[f64; 3]| (left..=right).contains(&edge[0]);
    let at = |pair: &[[f64; 3]], x: f64| {
        let ([from, a, b], [to, c, d]) = (pair[0], pair[1]);
        let t = (x - from) / (to - from);
        [x, a + t * (c - a), b + t * (d - b)]
    };
    let mut clipped: Vec<[f64; 3]> = edges.first().copied().filter(inside).into_iter().collect();
    for pair in edges.windows(2) {
        let (from, to) = (pair[0][0], pair[1][0]);
        let ends = if from < to { [left, right] } else { [right, left] };
        let between = |x: &f64| (from < *x && *x < to) || (to < *x && *x < from);
        clipped.extend(ends.into_iter().filter(between).map(|x| at(pair, x)));
        if inside(&pair[1]) {
            clipped.push(pair[1]);
        }
    }
    clipped
}

/// The parts of a curve whose y values lie between two limits.
fn within(curve: &[Point], [bottom, top]: [f64; 2]) -> Vec<Vec<Point>> {
    let inside = |point: &Point| (bottom..=top).contains(&point[1]);
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = curve.first().copied().filter(inside).into_iter().collect();
    for pair in curve.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        if let Some((enter, leave)) = between(from, to, bottom, top) {
            if !inside(&from) {
                piece = vec![enter];
            }
            piece.push(leave);
        }
        if !inside(&to) && !piece.is_empty() {
            pieces.push(std::mem::take(&mut piece));
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// The part of a segment between two limits, if any.
fn between(from: Point, to: Point, bottom: f64, top: f64) -> Option<(Point, Point)> {
    let at = |part: f64| [from[0] + part * (to[0] - from[0]), (from[1] + part * (to[1] - from[1])).clamp(bottom, top)];
    let rise = to[1] - from[1];
    if rise == 0.0 {
        return (bottom..=top).contains(&from[1]).then_some((from, to));
    }
    let (a, b) = ((bottom - from[1]) / rise, (top - from[1]) / rise);
    let (first, last) = (a.min(b).max(0.0), a.max(b).min(1.0));
    (first < last).then(|| (at(first), at(last)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: [f64; 2] = [-10.0, 10.0];

    #[test]
    fn a_spike_is_cut_in_two() {
        let spike = [[0.0, 0.0], [1.0, 4.0], [2.0, 0.0]];
        let pieces = clip(&spike, WIDE, [0.0, 2.0]);
        assert_eq!(pieces, [[[0.0, 0.0], [0.5, 2.0]], [[1.5, 2.0], [2.0, 0.0]]]);
    }

    #[test]
    fn what_lies_inside_stays_and_what_lies_outside_goes() {
        let line = [[0.0, 0.5], [1.0, 0.5], [2.0, 1.0]];
        assert_eq!(clip(&line, WIDE, [0.0, 1.0]), [line.to_vec()]);
        assert!(clip(&line, WIDE, [2.0, 3.0]).is_empty());
        assert!(clip(&[], WIDE, [0.0, 1.0]).is_empty());
    }

    #[test]
    fn a_segment_may_cross_the_whole_panel() {
        let pieces = clip(&[[0.0, -1.0], [1.0, 3.0]], WIDE, [0.0, 2.0]);
        assert_eq!(pieces, [[[0.25, 0.0], [0.75, 2.0]]]);
        let pieces = clip(&[[-1.0, 0.0], [3.0, 1.0]], [0.0, 2.0], WIDE);
        assert_eq!(pieces, [[[0.0, 0.25], [2.0, 0.75]]]);
    }

    #[test]
    fn a_band_is_cut_where_the_range_ends() {
        let band = [[0.0, 0.0, 1.0], [4.0, 4.0, 5.0]];
        assert_eq!(clip_band(&band, [1.0, 2.0]), [[1.0, 1.0, 2.0], [2.0, 2.0, 3.0]]);
        assert_eq!(clip_band(&band, [-1.0, 5.0]), band);
        assert!(clip_band(&band, [6.0, 7.0]).is_empty());
    }
}
