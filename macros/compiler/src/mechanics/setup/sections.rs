//! The sections of beams as the coordinates of inertia and elasticity.
//!
//! A beam's coordinates are few, but each of them turns every section. Inertia, weight and elasticity are therefore
//! derived as if each section turned by itself: by its own Rodrigues vector, and at the places of quadrature by the
//! slope of this vector along the beam. Matrices between sections are short, and a product with constant numbers,
//! the values of the polynomials at the sections, turns them into those of the coordinates, as the sums along a run do
//! for absolute angles ([`Runs`](super::runs::Runs)). Nothing is expanded in powers of the coordinates.

use crate::algebra::{ExprId, Graph, Stage, SymbolId};
use crate::base::ids::BeamId;
use crate::base::legendre::{derivatives, integrals, polynomials};
use crate::model::mechanism::{Beam, Mechanism};
use crate::topology::Topology;

use super::coordinate::CoordinateMotion;
use super::symbols::{SymbolList, Symbols};

/// The motion of three components: of a Rodrigues vector, or of its slope.
pub(crate) type Components<T> = [T; 3];

/// How the entries of a matrix on the two sides of its diagonal are related.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mirrored {
    Equal,
    Opposite,
    Unrelated,
}

/// One component of a section's rotation or slope, as a sum over the unknowns.
#[derive(Clone, Debug)]
pub(crate) struct SectionRow {
    /// Unknowns with their factors.
    pub(crate) weights: Vec<(usize, f64)>,
    /// The row at the mirrored place of quadrature, where each polynomial has the same value or the opposite one.
    mirrored: Option<usize>,
}

/// The rows of one beam; `None` where nothing turns.
#[derive(Clone, Debug, Default)]
pub(crate) struct OfBeam<T> {
    /// Rotations at the places of quadrature.
    pub(crate) rotations: Vec<Components<T>>,
    /// Slopes of the rotations there, along the length as a fraction.
    pub(crate) slopes: Vec<Components<T>>,
    /// Slopes of the slopes, where sections shear with the change of the moments.
    pub(crate) curls: Vec<Components<T>>,
    /// Strain along the beam and shear across it, where these are coordinates.
    pub(crate) strains: Vec<Components<T>>,
    /// Rotations of the stations.
    pub(crate) stations: Vec<Components<T>>,
}

impl<T: Copy> OfBeam<T> {
    /// What is known at the places of quadrature: a list of each kind.
    fn at_sections(&self) -> [&[Components<T>]; 4] {
        [&self.rotations, &self.slopes, &self.curls, &self.strains]
    }

    pub(crate) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> OfBeam<U> {
        let mut all =
            |list: &[Components<T>]| -> Vec<Components<U>> { list.iter().map(|x| x.map(&mut change)).collect() };
        OfBeam {
            rotations: all(&self.rotations),
            slopes: all(&self.slopes),
            curls: all(&self.curls),
            strains: all(&self.strains),
            stations: all(&self.stations),
        }
    }
}

impl OfBeam<Option<usize>> {
    /// All rows.
    pub(crate) fn rows(&self) -> Vec<usize> {
        self.at_sections().into_iter().chain([&self.stations[..]]).flatten().flatten().flatten().copied().collect()
    }

    /// The rows of one section.
    pub(crate) fn of_section(&self, k: usize) -> Vec<usize> {
        self.at_sections().into_iter().flat_map(|list| list[k]).flatten().collect()
    }
}

/// The rows of all beams, with symbols for each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sections {
    pub(crate) rows: Vec<SectionRow>,
    beams: Vec<OfBeam<Option<usize>>>,
    pub(crate) position: SymbolList,
    pub(crate) velocity: SymbolList,
    pub(crate) acceleration: SymbolList,
}

impl Sections {
    pub(crate) fn new(g: &mut Graph, mechanism: &Mechanism, topology: &Topology) -> Self {
        let mut this = Self::default();
        for beam in &mechanism.beams {
            let beam_rows = this.beam(g, topology, beam);
            for list in beam_rows.at_sections() {
                for (here, there) in list.iter().zip(list.iter().rev()) {
                    for (row, mirrored) in here.iter().zip(there) {
                        if let (Some(row), false) = (*row, row == mirrored) {
                            this.rows[row].mirrored = *mirrored;
                        }
                    }
                }
            }
            this.beams.push(beam_rows);
        }
        this
    }

    fn beam(&mut self, g: &mut Graph, topology: &Topology, beam: &Beam) -> OfBeam<Option<usize>> {
        let name = beam.name.clone();
        let mut row = |label: String, component: usize, factors: fn(usize, f64) -> Vec<f64>, x| {
            let ids = if label.starts_with("strain") { &beam.strains[component] } else { &beam.coordinates[component] };
            let last = ids.len().checked_sub(1)?;
            let factors = factors(last, x);
            let unknown = |id| topology.free.iter().position(|x| x == id);
            let weights: Vec<(usize, f64)> = ids
                .iter()
                .zip(factors)
                .filter(|(_, factor)| factor.abs() > 1e-15)
                .filter_map(|(id, factor)| Some((unknown(id)?, factor)))
                .collect();
            let label = format!("{name}_{label}_{}", ["x", "y", "z"][component]);
            self.push(g, &label, weights)
        };
        let (mut rotations, mut slopes) = (Vec::new(), Vec::new());
        let (mut curls, mut strains) = (Vec::new(), Vec::new());
        for (k, (fraction, ..)) in beam.sections.iter().enumerate() {
            let mut rows = |what: &str, factors| {
                [0, 1, 2].map(|component| row(format!("{what}_{k}"), component, factors, *fraction))
            };
            rotations.push(rows("section", integrals));
            slopes.push(rows("slope", polynomials));
            curls.push(if beam.static_shear { rows("curl", derivatives) } else { [None; 3] });
            strains.push(rows("strain", polynomials));
        }
        let stations = beam.stations.iter().enumerate();
        let stations = stations.map(|(k, station)| {
            [0, 1, 2].map(|component| row(format!("station_{k}"), component, integrals, station.place))
        });
        let stations = stations.collect();
        OfBeam { rotations, slopes, curls, strains, stations }
    }

    fn push(&mut self, g: &mut Graph, label: &str, weights: Vec<(usize, f64)>) -> Option<usize> {
        if weights.is_empty() {
            return None;
        }
        let lists = [
            (&mut self.position, Stage::Configuration, ""),
            (&mut self.velocity, Stage::Rate, "rate_"),
            (&mut self.acceleration, Stage::Rate, "acceleration_"),
        ];
        for (list, stage, prefix) in lists {
            let (id, value) = g.symbol(format!("{prefix}{label}"), stage);
            list.ids.push(id);
            list.values.push(value);
        }
        self.rows.push(SectionRow { weights, mirrored: None });
        Some(self.rows.len() - 1)
    }

    /// The rows of a beam.
    pub(crate) fn of(&self, beam: BeamId) -> &OfBeam<Option<usize>> {
        &self.beams[beam.index()]
    }

    /// The unknowns that a beam's rows are sums of.
    pub(crate) fn unknowns(&self, beam: BeamId) -> Vec<usize> {
        let rows = self.of(beam).rows().into_iter();
        let mut unknowns: Vec<usize> =
            rows.flat_map(|row| self.rows[row].weights.iter().map(|(unknown, _)| *unknown)).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }

    /// The motion of a beam's sections by their own symbols.
    pub(crate) fn by_themselves(&self, g: &mut Graph, beam: BeamId) -> OfBeam<CoordinateMotion> {
        let zero = g.zero();
        self.of(beam).map(|row| CoordinateMotion {
            position: row.map_or(zero, |row| self.position.values[row]),
            velocity: row.map_or(zero, |row| self.velocity.values[row]),
            acceleration: row.map_or(zero, |row| self.acceleration.values[row]),
        })
    }

    /// The motion of a beam's sections by the unknowns.
    pub(crate) fn by_unknowns(&self, g: &mut Graph, symbols: &Symbols, beam: BeamId) -> OfBeam<CoordinateMotion> {
        let zero = g.zero();
        self.of(beam).map(|row| {
            let mut sum = |list: &SymbolList| match row {
                Some(row) => self.combined(g, row, &list.values),
                None => zero,
            };
            CoordinateMotion {
                position: sum(&symbols.q),
                velocity: sum(&symbols.velocity),
                acceleration: sum(&symbols.acceleration),
            }
        })
    }

    /// Rotation and slope at any place of a beam, by the unknowns.
    pub(crate) fn at(
        g: &mut Graph,
        symbols: &Symbols,
        topology: &Topology,
        beam: &Beam,
        fraction: f64,
    ) -> [Components<ExprId>; 2] {
        [integrals as fn(usize, f64) -> Vec<f64>, polynomials].map(|factors| {
            [0, 1, 2].map(|component| {
                let ids = &beam.coordinates[component];
                let factors = factors(ids.len(), fraction);
                let terms: Vec<ExprId> = ids
                    .iter()
                    .zip(factors)
                    .filter_map(|(id, factor)| {
                        let unknown = topology.free.iter().position(|x| x == id)?;
                        Some(g.scale(factor, symbols.q.values[unknown]))
                    })
                    .collect();
                g.sum(terms)
            })
        })
    }

    /// The rate of each row while the unknowns move at some rates.
    pub(crate) fn rates(&self, g: &mut Graph, unknowns: &[ExprId]) -> Vec<ExprId> {
        let rows = 0..self.rows.len();
        rows.map(|row| self.combined(g, row, unknowns)).collect()
    }

    /// Each symbol as a sum over the unknowns: for substitution.
    pub(crate) fn sums(&self, g: &mut Graph, symbols: &Symbols) -> Vec<(SymbolId, ExprId)> {
        let lists = [
            (&self.position, &symbols.q),
            (&self.velocity, &symbols.velocity),
            (&self.acceleration, &symbols.acceleration),
        ];
        let mut sums = Vec::new();
        for (list, unknowns) in lists {
            let values = self.rates(g, &unknowns.values);
            sums.extend(list.ids.iter().copied().zip(values));
        }
        sums
    }

    /// The mirrored row, unless a single polynomial has values at both.
    fn mirrored(&self, row: usize) -> Option<usize> {
        let row = &self.rows[row];
        row.mirrored.filter(|_| row.weights.len() > 1)
    }

    /// The unknowns of a row with their factors, split into what is equal and what is opposite at the mirrored row.
    fn parts(&self, row: usize) -> Vec<(usize, f64, f64)> {
        let weights = &self.rows[row].weights;
        let Some(mirrored) = self.mirrored(row) else {
            return weights.iter().map(|(unknown, factor)| (*unknown, *factor, 0.0)).collect();
        };
        let there = &self.rows[mirrored].weights;
        let both = weights.iter().zip(there);
        let clean = |factor: f64| if factor.abs() > 1e-15 { factor } else { 0.0 };
        both.map(|((unknown, here), (_, there))| (*unknown, clean(0.5 * (here + there)), clean(0.5 * (here - there))))
            .collect()
    }

    /// The value of a row.
    fn combined(&self, g: &mut Graph, row: usize, unknowns: &[ExprId]) -> ExprId {
        let first = self.mirrored(row).map_or(row, |mirrored| mirrored.min(row));
        let (mut even, mut odd) = (Vec::new(), Vec::new());
        for (unknown, equal, opposite) in self.parts(first) {
            even.push(g.scale(equal, unknowns[unknown]));
            odd.push(g.scale(opposite, unknowns[unknown]));
        }
        let (even, odd) = (g.sum(even), g.sum(odd));
        if first == row { g.add(even, odd) } else { g.sub(even, odd) }
    }

    /// Forces along the unknowns, from forces along the unknowns followed by those along the sections.
    pub(crate) fn forces(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        let (coordinates, sections) = along.split_at(along.len() - self.rows.len());
        let mut terms: Vec<Vec<ExprId>> = coordinates.iter().map(|x| vec![*x]).collect();
        for row in 0..self.rows.len() {
            let force = sections[row];
            let (sum, difference) = match self.mirrored(row) {
                Some(mirrored) if mirrored < row => continue,
                Some(mirrored) => (g.add(force, sections[mirrored]), g.sub(force, sections[mirrored])),
                None => (force, force),
            };
            if g.is(sum, 0.0) && g.is(difference, 0.0) {
                continue;
            }
            for (unknown, even, odd) in self.parts(row) {
                for (factor, force) in [(even, sum), (odd, difference)] {
                    terms[unknown].push(g.scale(factor, force));
                }
            }
        }
        terms.into_iter().map(|terms| g.sum(terms)).collect()
    }

    /// Transforms a matrix by columns from the unknowns and the sections to the unknowns.
    pub(crate) fn matrix(&self, g: &mut Graph, columns: &[Vec<ExprId>], mirrored: Mirrored) -> Vec<Vec<ExprId>> {
        if self.rows.is_empty() {
            return columns.to_vec();
        }
        let size = columns.len();
        let columns: Vec<Vec<ExprId>> = (0..size)
            .map(|j| {
                let mut entry = |i: usize| match mirrored {
                    Mirrored::Equal if i > j => columns[i][j],
                    Mirrored::Opposite if i > j => g.neg(columns[i][j]),
                    _ => columns[j][i],
                };
                (0..size).map(&mut entry).collect()
            })
            .collect();
        let rows: Vec<Vec<ExprId>> = (0..size)
            .map(|i| {
                let row: Vec<ExprId> = columns.iter().map(|column| column[i]).collect();
                self.forces(g, &row)
            })
            .collect();
        let n = size - self.rows.len();
        (0..n)
            .map(|j| {
                let column: Vec<ExprId> = rows.iter().map(|row| row[j]).collect();
                self.forces(g, &column)
            })
            .collect()
    }
}
