//! Cutting a curve where it leaves the figure: plotters itself would draw it across title and labels.

use super::Point;

/// The parts of a curve between `bottom` and `top`, with new end points on these lines.
pub(super) fn clip(curve: &[Point], bottom: f64, top: f64) -> Vec<Vec<Point>> {
    let inside = |point: &Point| (bottom..=top).contains(&point.1);
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

/// The part of a segment between two values, if any.
fn between(from: Point, to: Point, bottom: f64, top: f64) -> Option<(Point, Point)> {
    let at = |part: f64| {
        (
            from.0 + part * (to.0 - from.0),
            (from.1 + part * (to.1 - from.1)).clamp(bottom, top),
        )
    };
    let rise = to.1 - from.1;
    if rise == 0.0 {
        return (bottom..=top).contains(&from.1).then_some((from, to));
    }
    let (a, b) = ((bottom - from.1) / rise, (top - from.1) / rise);
    let (first, last) = (a.min(b).max(0.0), a.max(b).min(1.0));
    (first < last).then(|| (at(first), at(last)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_is_cut_in_two() {
        let spike = [(0.0, 0.0), (1.0, 4.0), (2.0, 0.0)];
        let pieces = clip(&spike, 0.0, 2.0);
        assert_eq!(pieces, [[(0.0, 0.0), (0.5, 2.0)], [(1.5, 2.0), (2.0, 0.0)]]);
    }

    #[test]
    fn what_lies_inside_stays_and_what_lies_outside_goes() {
        let line = [(0.0, 0.5), (1.0, 0.5), (2.0, 1.0)];
        assert_eq!(clip(&line, 0.0, 1.0), [line.to_vec()]);
        assert!(clip(&line, 2.0, 3.0).is_empty());
        assert!(clip(&[], 0.0, 1.0).is_empty());
    }

    #[test]
    fn a_segment_may_cross_the_whole_figure() {
        let pieces = clip(&[(0.0, -1.0), (1.0, 3.0)], 0.0, 2.0);
        assert_eq!(pieces, [[(0.25, 0.0), (0.75, 2.0)]]);
    }
}
