//! The integers of a single solved state that decide about events.
//!
//! | event | integer |
//! | --- | --- |
//! | a frequency meets a line `L` | frequencies above `L` |
//! | flutter starts or stops | growing oscillations |
//! | stiffness vanishes | negative eigenvalues of a symmetric `Khat`; otherwise motions that grow without oscillation |
//!
//! A number within its error of the threshold does not count: the state is at the event.

use super::spectrum::{Root, Spectrum};
use crate::sweep::condition::Line;

/// What to look for, and what is known about the eigenvalues.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    pub(super) lines: Vec<Line>,
    /// Oscillations that start or stop growing.
    pub(super) growth: bool,
    /// Vanishing stiffness.
    pub(super) critical: bool,
    /// The eigenvalues of the modes are `lambda`.
    pub(super) undamped: bool,
    /// `Khat` is symmetric, and has eigenvalues `lambda` of its own.
    pub(super) symmetric: bool,
    /// Nothing feeds or takes energy: positive stiffness excludes growth.
    pub(super) conservative: bool,
}

/// What an integer counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Frequencies above the line at this position.
    Line(usize),
    /// Growing oscillations.
    Growth,
    /// Directions without stiffness.
    Critical,
}

impl Wanted {
    pub(super) fn kinds(&self) -> Vec<Kind> {
        let lines = (0..self.lines.len()).map(Kind::Line);
        let growth = self.growth.then_some(Kind::Growth);
        self.critical.then_some(Kind::Critical).into_iter().chain(growth).chain(lines).collect()
    }

    /// The eigenvalues that an integer is about.
    pub(super) fn roots<'a>(&self, kind: Kind, state: &'a Spectrum) -> &'a [Root] {
        match kind {
            Kind::Critical if self.symmetric && !self.undamped => &state.stiffness,
            _ => &state.roots,
        }
    }

    /// The line at a state and its derivative along the step; no frequency is negative.
    pub(super) fn line(&self, k: usize, state: &Spectrum) -> [f64; 2] {
        let (Line { ratio, offset }, [u, du]) = (self.lines[k], state.input);
        match ratio * u + offset {
            line if line > 0.0 => [line, ratio * du],
            _ => [0.0, 0.0],
        }
    }

    /// The number of an eigenvalue that decides, positive where it counts, its derivative along the step, and its error.
    pub(super) fn number(&self, kind: Kind, state: &Spectrum, root: &Root) -> ([f64; 2], f64) {
        let (value, slope) = (root.value, root.slope);
        match kind {
            Kind::Line(k) => {
                let [line, rate] = self.line(k, state);
                if self.undamped {
                    let error = root.error + 4.0 * f64::EPSILON * line * line;
                    let jet = [value.re - line * line, slope.re - 2.0 * line * rate];
                    return (jet, error);
                }
                let error = root.error + 4.0 * f64::EPSILON * line.abs();
                ([value.im - line, slope.im - rate], error)
            }
            Kind::Critical if self.real(kind) => ([-value.re, -slope.re], root.error),
            Kind::Growth | Kind::Critical => ([value.re, slope.re], root.error),
        }
    }

    /// Whether the eigenvalues of an integer are those of symmetric matrices, which are smooth where they cross.
    pub(super) fn real(&self, kind: Kind) -> bool {
        self.undamped || kind == Kind::Critical && self.symmetric
    }

    /// Whether an eigenvalue may count at all.
    pub(super) fn relevant(&self, kind: Kind, root: &Root) -> bool {
        self.real(kind) || root.paired != (kind == Kind::Critical)
    }

    fn counts(&self, kind: Kind, state: &Spectrum, root: &Root) -> bool {
        let above = || {
            let ([value, _], error) = self.number(kind, state, root);
            value > error
        };
        let counts = match kind {
            Kind::Line(_) => above(),
            Kind::Critical if self.real(kind) => above(),
            Kind::Growth | Kind::Critical => root.grows,
        };
        counts && self.relevant(kind, root)
    }

    /// Whether an eigenvalue can be at the threshold: no frequency is at a line that is not positive.
    pub(super) fn meets(&self, kind: Kind, state: &Spectrum) -> bool {
        match kind {
            Kind::Line(k) => self.line(k, state)[0] > 0.0,
            _ => true,
        }
    }

    /// Whether the number of an eigenvalue is within its error of the threshold.
    pub(super) fn touches(&self, kind: Kind, state: &Spectrum, root: &Root) -> bool {
        let ([value, _], error) = self.number(kind, state, root);
        self.meets(kind, state) && self.relevant(kind, root) && value.abs() <= error
    }

    /// Positions of the eigenvalues that count.
    pub(super) fn counted(&self, kind: Kind, state: &Spectrum) -> Vec<usize> {
        let roots = self.roots(kind, state).iter().enumerate();
        roots.filter(|(_, root)| self.counts(kind, state, root)).map(|(r, _)| r).collect()
    }

    pub(super) fn count(&self, kind: Kind, state: &Spectrum) -> usize {
        self.counted(kind, state).len()
    }

    /// How many numbers are within their errors of the threshold.
    pub(super) fn doubtful(&self, kind: Kind, state: &Spectrum) -> usize {
        self.roots(kind, state).iter().filter(|root| self.touches(kind, state, root)).count()
    }
}

impl Spectrum {
    /// Number of motions that grow without oscillation.
    pub(super) fn divergent(&self) -> usize {
        self.roots.iter().filter(|root| root.grows && !root.paired).count()
    }
}
