//! Parts of an assembly that nothing joins, as torsion beside bending or one shaft beside another.
//!
//! Modes are sought in each by itself: neither the rounding of a stiff part nor an equal eigenvalue of another then hides one.

use std::borrow::Cow;

use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Matrix, Vector};

use crate::assembly::Assembly;
use crate::error::Error;
use crate::modes::{Found, Mode};
use crate::pencil::Pencil;

/// What joins two unknowns, as a part of what resists each, below which it is rounding.
const JOINED: f64 = 16.0 * f64::EPSILON;

/// Unknowns that matrices or spans join, as an assembly of their own.
struct Part<'a> {
    own: Cow<'a, Assembly>,
    /// Which of the unknowns of the whole.
    places: Vec<usize>,
}

/// Which modes are sought besides those that continue given ones.
#[derive(Clone, Copy, Debug)]
pub enum Others<'a> {
    /// So many of the lowest, if one of those given is no more.
    WhereOneEnds(usize),
    /// So many of the lowest.
    Lowest(usize),
    /// Those that continue these.
    Continuing(&'a [Mode]),
}

impl Assembly {
    /// Up to `count` modes of lowest `|s|` that oscillate and in which stations move, by frequency. The search can miss one:
    /// [`Self::count_within`] tells.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn modes(&self, count: usize) -> Result<Vec<Found>, Error> {
        Ok(self.continued(&[], Others::Lowest(count))?.into_iter().map(|(found, _)| found).collect())
    }

    /// The modes that continue those of a neighbouring speed or design, and `others` behind them; each with the terms that
    /// cancel in it ([`Self::terms`]).
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn continued(&self, from: &[Mode], others: Others<'_>) -> Result<Vec<(Found, f64)>, Error> {
        let parts = self.parts();
        let of_parts = |of: &dyn Fn(&Part<'_>) -> Result<Vec<Found>, Error>| {
            let mut all = Vec::new();
            for (k, part) in parts.iter().enumerate() {
                all.extend(of(part)?.into_iter().map(|own| (k, own)));
            }
            Ok(all)
        };
        let mut found = of_parts(&|part| Ok(part.own.following(&part.of(from))))?;
        let more = match others {
            Others::WhereOneEnds(_) if found.len() == from.len() => Vec::new(),
            Others::WhereOneEnds(count) | Others::Lowest(count) => {
                let mut all = of_parts(&|part| part.own.lowest(count))?;
                all.sort_by(|(_, a), (_, b)| a.0.s.norm().total_cmp(&b.0.s.norm()));
                all.truncate(count);
                all.sort_by(|(_, a), (_, b)| a.0.s.im.total_cmp(&b.0.s.im));
                all
            }
            Others::Continuing(beside) => of_parts(&|part| Ok(part.own.following(&part.of(beside))))?,
        };
        for (k, own) in more {
            if parts[k].own.is_new(&own.0, found.iter().filter(|(part, _)| *part == k).map(|(_, other)| &other.0)) {
                found.push((k, own));
            }
        }
        let terms: Vec<f64> = parts.iter().map(|part| part.own.terms()).collect();
        Ok(found.into_iter().map(|(k, own)| (parts[k].in_whole(own, self.stations()), terms[k])).collect())
    }

    /// Whether these are all that the search would find below the greatest of them, as far as Krylov spaces tell.
    #[must_use]
    pub fn has_all(&self, known: &[Mode]) -> bool {
        let greatest = known.iter().map(|mode| mode.s.norm()).fold(0.0, f64::max);
        let is_complete = |part: &Part<'_>| {
            let own = part.of(known);
            // A part that is not the whole may have none of them, and others.
            part.own.has(&own, own.len() + usize::from(!part.is_whole()), greatest)
        };
        self.parts().iter().all(is_complete)
    }

    /// The number of motions that grow without oscillating, as on springs that push away, at rates up to those of the lowest
    /// frequencies.
    ///
    /// # Errors
    /// [`Error::NotConverged`].
    pub fn divergent(&self) -> Result<usize, Error> {
        self.parts().iter().map(|part| part.own.diverging()).sum()
    }

    /// The parts in which something moves; the whole where there is but one.
    fn parts(&self) -> Vec<Part<'_>> {
        let groups = self.groups();
        if groups.len() == 1 {
            return vec![Part { own: Cow::Borrowed(self), places: (0..self.stations()).collect() }];
        }
        let all = groups.into_iter().map(|places| Part { own: Cow::Owned(self.restricted(&places)), places });
        all.filter(|part| part.own.moves()).collect()
    }

    /// What resists each unknown, in each of the matrices with that of spans.
    fn resistances(&self) -> [Vec<f64>; 3] {
        let mut all =
            self.matrices().map(|matrix| (0..self.stations()).map(|k| matrix[k][k].abs()).collect::<Vec<_>>());
        for span in self.spans() {
            let (mass, stiffness) = (span.mass(), span.stiffness());
            for (k, (unknown, _)) in
                span.ends.iter().flat_map(|end| end.iter().enumerate()).filter_map(|(k, end)| Some((k, (*end)?)))
            {
                let arm = if k % 2 == 1 { span.length().powi(2) } else { 1.0 };
                all[0][unknown] += mass * arm;
                all[2][unknown] += stiffness * arm;
            }
        }
        all
    }

    /// The unknowns of each part.
    fn groups(&self) -> Vec<Vec<usize>> {
        let count = self.stations();
        let mut group: Vec<usize> = (0..count).collect();
        let mut join = |a: usize, b: usize| {
            let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
            group.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
        };
        for span in self.spans() {
            let mut unknowns = span.unknowns();
            if let Some(first) = unknowns.next() {
                unknowns.for_each(|other| join(first, other));
            }
        }
        for (matrix, own) in self.matrices().iter().zip(self.resistances()) {
            for i in 0..count {
                for j in 0..i {
                    let size = matrix[i][j].abs().max(matrix[j][i].abs());
                    if size > JOINED * (own[i] * own[j]).sqrt() {
                        join(i, j);
                    }
                }
            }
        }
        let firsts = (0..count).filter(|&k| group[k] == k);
        firsts.map(|first| (0..count).filter(|&k| group[k] == first).collect()).collect()
    }
}

impl Part<'_> {
    fn is_whole(&self) -> bool {
        matches!(self.own, Cow::Borrowed(_))
    }

    /// Those of the modes that are of this part.
    fn of(&self, modes: &[Mode]) -> Vec<Mode> {
        if self.is_whole() {
            return modes.to_vec();
        }
        let within = |x: &Vector<Complex>| -> Vector<Complex> { self.places.iter().map(|&k| x[k]).collect() };
        let size = |x: &[Complex]| x.iter().map(Complex::norm_sqr).sum::<f64>();
        let restricted = |mode: &Mode| {
            let own = Mode { s: mode.s, right: within(&mode.right), left: within(&mode.left) };
            (2.0 * size(&own.right) > size(&mode.right)).then_some(own)
        };
        modes.iter().filter_map(restricted).collect()
    }

    /// A mode of this part as one of a whole with so many unknowns.
    fn in_whole(&self, (mode, pencil): Found, count: usize) -> Found {
        if self.is_whole() {
            return (mode, pencil);
        }
        let vector = |own: &Vector<Complex>| {
            let mut whole = Vector::zeros(count);
            self.places.iter().zip(own).for_each(|(&k, x)| whole[k] = *x);
            whole
        };
        let matrix = |own: &Matrix<Complex>| {
            let mut whole = Matrix::zeros(count, count);
            for (&i, row) in self.places.iter().zip(own.iter()) {
                self.places.iter().zip(row).for_each(|(&j, x)| whole[i][j] = *x);
            }
            whole
        };
        let pencil = Pencil { s: pencil.s, matrix: matrix(&pencil.matrix), slope: matrix(&pencil.slope) };
        (Mode { s: mode.s, right: vector(&mode.right), left: vector(&mode.left) }, pencil)
    }
}
