//! The number of an event at a single state, for the eigenvalues nearest to given ones.

use super::cubic::Jet;
use super::scalars::{Kind, Wanted, difference, squared_difference};
use super::spectrum::{Root, Spectrum, Two, sum_and_product};
use crate::Complex;
use crate::sweep::condition::Line;

/// The number of an event at one state.
pub(super) struct Picked {
    /// Positions of its eigenvalues; twice the same if it has one.
    pub(super) positions: [usize; 2],
    pub(super) jet: Jet,
}

/// The number of an event of this kind for the eigenvalues nearest to `near`.
pub(super) fn pick(
    wanted: &Wanted,
    kind: Kind,
    spectrum: &Spectrum,
    near: [Complex; 2],
) -> Option<Picked> {
    let roots = &spectrum.roots;
    let oscillates = |root: &Root| wanted.undamped || root.paired;
    let first = nearest(roots, near[0], None, oscillates);
    let alone = |value: f64, slope: f64| {
        first.map(|r| Picked {
            positions: [r; 2],
            jet: Jet {
                value,
                slope,
                error: roots[r].error,
            },
        })
    };
    match kind {
        Kind::Line(k) => {
            let (Line { ratio, offset }, [u, du]) = (wanted.lines[k], spectrum.input);
            let (own, line) = (&roots[first?], ratio * u + offset);
            match wanted.undamped {
                true => alone(
                    own.value.re - line * line,
                    own.slope.re - 2.0 * line * ratio * du,
                ),
                false => alone(own.value.im - line, own.slope.im - ratio * du),
            }
        }
        Kind::Growth | Kind::Critical => {
            let own = &roots[first?];
            alone(own.value.re, own.slope.re)
        }
        Kind::Merging => {
            let (first, second) = (first?, nearest(roots, near[1], first, oscillates)?);
            Some(Picked {
                positions: [first, second],
                jet: difference(&roots[first], &roots[second]),
            })
        }
        Kind::Turning => {
            let one = nearest(roots, near[0], None, |root| !root.paired);
            let other = nearest(roots, near[0], one, |root| !root.paired);
            let apart =
                |r: Option<usize>| r.map_or(f64::INFINITY, |r| (roots[r].value - near[0]).norm());
            let (two, positions) = match (one, other) {
                (Some(a), Some(b)) if apart(other) < apart(first) => (Two::Real(a, b), [a, b]),
                _ => (Two::Pair(first?), [first?; 2]),
            };
            let [sum, product] = sum_and_product(roots, two);
            Some(Picked {
                positions,
                jet: squared_difference(sum, product, roots[positions[0]].error),
            })
        }
    }
}

/// Position of the eigenvalue nearest to a value, among those that are `wanted`, except one.
fn nearest(
    roots: &[Root],
    to: Complex,
    but: Option<usize>,
    wanted: impl Fn(&Root) -> bool,
) -> Option<usize> {
    let all = roots.iter().enumerate();
    let all = all.filter(|(r, root)| wanted(root) && Some(*r) != but);
    let apart = |root: &Root| (root.value - to).norm();
    let found = all.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    found.map(|(r, _)| r)
}
