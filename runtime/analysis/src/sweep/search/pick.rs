//! The number of an event at a single state, for the eigenvalues nearest to given ones.

use super::cubic::Jet;
use super::scalars::{Kind, Wanted, difference, squared_difference};
use super::spectrum::{Root, Spectrum, Two, nearest_two, sum_and_product};
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
            let (root, line) = (&roots[first?], ratio * u + offset);
            match wanted.undamped {
                true => alone(
                    root.value.re - line * line,
                    root.slope.re - 2.0 * line * ratio * du,
                ),
                false => alone(root.value.im - line, root.slope.im - ratio * du),
            }
        }
        Kind::Growth => {
            let root = &roots[first?];
            alone(root.value.re, root.slope.re)
        }
        Kind::Critical if near[0] != near[1] => {
            let (two, positions) = two_near(roots, near)?;
            let [sum, product] = sum_and_product(roots, two);
            let error = roots[positions[0]].error * sum[0].abs();
            Some(Picked {
                positions,
                jet: Jet {
                    value: product[0],
                    slope: product[1],
                    error,
                },
            })
        }
        Kind::Critical => {
            let candidates = match wanted.symmetric && !wanted.undamped {
                true => &spectrum.stiffness,
                false => roots,
            };
            let r = nearest(candidates, near[0], None, |root| !root.paired)?;
            Some(Picked {
                positions: [r; 2],
                jet: Jet {
                    value: candidates[r].value.re,
                    slope: candidates[r].slope.re,
                    error: candidates[r].error,
                },
            })
        }
        Kind::Merging => {
            let first = first?;
            let other = |root: &Root| oscillates(root) && !root.is_like(&roots[first]);
            let second = nearest(roots, near[1], Some(first), other)?;
            Some(Picked {
                positions: [first, second],
                jet: difference(&roots[first], &roots[second]),
            })
        }
        Kind::Turning => {
            let (two, positions) = two_near(roots, near)?;
            let [sum, product] = sum_and_product(roots, two);
            Some(Picked {
                positions,
                jet: squared_difference(sum, product, roots[positions[0]].error),
            })
        }
    }
}

/// The conjugate pair, or the two real eigenvalues, whose sum and product are nearest to those of two values.
fn two_near(roots: &[Root], near: [Complex; 2]) -> Option<(Two, [usize; 2])> {
    let wanted = [(near[0] + near[1]).re, (near[0] * near[1]).re];
    let two = nearest_two(roots, wanted)?;
    let positions = match two {
        Two::Pair(r) => [r; 2],
        Two::Real(a, b) => [a, b],
    };
    Some((two, positions))
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
    let closest = all.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    closest.map(|(r, _)| r)
}
