//! Spans of shafts between stations, and everything else there is at the stations.

use eigentol_numerics::Complex;
use eigentol_numerics::algebra::{Lu, Matrix, Vector};

use crate::basis::{Class, MOST, classes};
use crate::chain::{Along, Chain};
use crate::element::{Element, Node, loads};
use crate::error::Error;
use crate::motion::{Kept, Motion, Side};
use crate::section::{Coefficients, Line, TERMS, at, slope_at};
use crate::span::{Span, check};

/// Spans with what is at their stations: `T(s) = s^2 M + s C + K + spans(s)`.
#[derive(Clone, Debug)]
pub struct Assembly {
    spans: Vec<Span>,
    /// Which of its different sections each section of a span is.
    kinds: Vec<Vec<usize>>,
    /// Of the different sections of each span in each direction.
    coefficients: Vec<Vec<Vec<Coefficients>>>,
    mass: Matrix,
    damping: Matrix,
    stiffness: Matrix,
    degree: usize,
}

/// An assembly at one `s`, with everything between the stations eliminated.
#[derive(Clone, Debug)]
pub struct Condensed<'a> {
    assembly: &'a Assembly,
    /// 1/s.
    pub s: Complex,
    chains: Vec<Vec<Chain>>,
}

/// An assembly at one `s`, factored.
#[derive(Clone, Debug)]
pub struct At<'a> {
    pub(crate) condensed: Condensed<'a>,
    /// 1/s.
    pub s: Complex,
    factors: Lu<Complex>,
}

impl Assembly {
    /// Spans with mass, damping and stiffness of all else in terms of the unknowns of the stations, and the degree of the
    /// polynomials in each element: 4 has errors of `1e-8` in the frequencies whose waves are some three elements long.
    ///
    /// # Errors
    /// [`Error::Degree`], [`Error::Sizes`], [`Error::Place`], [`Error::NoSections`], [`Error::Number`].
    pub fn new(spans: Vec<Span>, [mass, damping, stiffness]: [Matrix; 3], degree: usize) -> Result<Self, Error> {
        if !(1..=MOST).contains(&degree) {
            return Err(Error::Degree { degree });
        }
        let count = mass.row_count();
        for matrix in [&mass, &damping, &stiffness] {
            if count == 0 || [matrix.row_count(), matrix.column_count()] != [count; 2] {
                return Err(Error::Sizes);
            }
        }
        for (index, span) in spans.iter().enumerate() {
            check(index, span, count)?;
        }
        let (mut kinds, mut coefficients) = (Vec::new(), Vec::new());
        for span in &spans {
            let (own, different) = span.kinds();
            let of = |direction: f64| different.iter().map(|&k| span.coefficients(k, direction)).collect();
            coefficients.push(span.directions().iter().map(|&direction| of(direction)).collect());
            kinds.push(own);
        }
        Ok(Self { spans, kinds, coefficients, mass, damping, stiffness, degree })
    }

    /// The number of unknowns of the stations.
    #[must_use]
    pub fn stations(&self) -> usize {
        self.mass.row_count()
    }

    /// The spans.
    #[must_use]
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    pub(crate) fn matrices(&self) -> [&Matrix; 3] {
        [&self.mass, &self.damping, &self.stiffness]
    }

    /// Whether anything can oscillate: only two of inertia, damping and stiffness do.
    pub(crate) fn moves(&self) -> bool {
        let acts = |matrix: &Matrix| matrix.as_flattened().iter().any(|entry| *entry != 0.0);
        !self.spans.is_empty() || self.matrices().into_iter().filter(|own| acts(own)).count() > 1
    }

    /// These unknowns alone, which nothing joins to others.
    pub(crate) fn restricted(&self, unknowns: &[usize]) -> Self {
        let count = unknowns.len();
        let [mass, damping, stiffness] =
            self.matrices().map(|of| Matrix::from_fn(count, count, |i, j| of[unknowns[i]][unknowns[j]]));
        let own = |span: &Span| span.unknowns().all(|unknown| unknowns.contains(&unknown));
        let kept: Vec<usize> = (0..self.spans.len()).filter(|&k| own(&self.spans[k])).collect();
        let moved = |&k: &usize| {
            let mut span = self.spans[k].clone();
            for (unknown, _) in span.ends.iter_mut().flatten().flatten() {
                *unknown = unknowns.iter().position(|own| own == unknown).unwrap_or_default();
            }
            span
        };
        Self {
            spans: kept.iter().map(moved).collect(),
            kinds: kept.iter().map(|&k| self.kinds[k].clone()).collect(),
            coefficients: kept.iter().map(|&k| self.coefficients[k].clone()).collect(),
            mass,
            damping,
            stiffness,
            degree: self.degree,
        }
    }

    /// The sum of the stiffnesses of the elements of spans that meet at stations over their mass and that of the stations, the
    /// greatest of all, 1/s^2: so large are the terms, beside the square of an eigenvalue, that cancel between the ends of
    /// elements. A short element is stiff, and what it leaves by rounding moves the mass of all that it is joined to.
    #[must_use]
    pub fn terms(&self) -> f64 {
        if self.spans.is_empty() {
            return self.rates().fold(0.0, f64::max);
        }
        let mut joined: Vec<Vec<&Span>> = Vec::new();
        for span in &self.spans {
            let meets = |group: &Vec<&Span>| group.iter().any(|other| span.meets(other));
            let (own, others): (Vec<_>, Vec<_>) = joined.into_iter().partition(meets);
            joined = others;
            joined.push(own.into_iter().flatten().chain([span]).collect());
        }
        let of_group = |group: &Vec<&Span>| {
            let mut stations: Vec<usize> = group.iter().flat_map(|span| span.deflections()).collect();
            stations.sort_unstable();
            stations.dedup();
            let heavy: f64 = stations.into_iter().map(|k| f64::max(self.mass[k][k], 0.0)).sum();
            let mass: f64 = group.iter().map(|span| span.mass()).sum();
            group.iter().map(|span| span.stiffness()).sum::<f64>() / (mass + heavy)
        };
        joined.iter().map(of_group).fold(0.0, f64::max)
    }

    /// Stiffness over mass of each unknown of the stations, and what damping adds, 1/s^2.
    pub(crate) fn rates(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.stations()).filter(|&k| self.mass[k][k] > 0.0).map(|k| {
            let damping = self.damping[k].iter().fold(0.0, |most, entry| f64::max(most, entry.abs()));
            (self.stiffness[k][k].abs() + damping * damping / self.mass[k][k]) / self.mass[k][k]
        })
    }

    pub(crate) fn classes_of(&self, line: Line) -> &'static [Class; 2] {
        classes(line, self.degree)
    }

    /// Which of the different sections of a span each element is.
    pub(crate) fn pieces(&self, span: usize) -> impl Iterator<Item = usize> + '_ {
        self.spans[span].pieces().map(move |section| self.kinds[span][section])
    }

    /// Which of the different sections of a span a section is.
    pub(crate) fn kind(&self, span: usize, section: usize) -> usize {
        self.kinds[span][section]
    }

    fn chain(&self, span: usize, direction: usize, s: Complex) -> Chain {
        let own = &self.spans[span];
        let classes = self.classes_of(own.line);
        let element = |(section, coefficients): (usize, &Coefficients)| {
            Element::new(classes, own.shape(section), &at(coefficients, s))
        };
        let elements = self.different(span, direction).map(element).collect();
        Chain::new(elements, self.pieces(span).collect(), own.components())
    }

    /// `s^2 M + s C + K` and its derivative: what is at the stations.
    pub(crate) fn of_stations(&self, s: Complex) -> [Matrix<Complex>; 2] {
        let [k, c, m] = [&self.stiffness, &self.damping, &self.mass].map(|matrix| matrix.as_flattened());
        let all = k.iter().zip(c).zip(m);
        let matrix = all.map(|((k, c), m)| s * (s * *m + *c) + *k).collect();
        let slope = c.iter().zip(m).map(|(c, m)| s * (2.0 * m) + *c).collect();
        [matrix, slope].map(|entries| Matrix::from_rows(self.stations(), entries))
    }

    /// What is at one station of this matrix, at its own unknown.
    pub(crate) fn of_station(&self, k: usize, s: Complex) -> Complex {
        s * (s * self.mass[k][k] + self.damping[k][k]) + self.stiffness[k][k]
    }

    /// Coefficients of the different sections of a span in a direction, each with one of these sections.
    pub(crate) fn different(&self, span: usize, direction: usize) -> impl Iterator<Item = (usize, &Coefficients)> {
        let section = move |kind: usize| self.kinds[span].iter().position(|other| *other == kind).unwrap_or_default();
        self.coefficients[span][direction].iter().enumerate().map(move |(kind, own)| (section(kind), own))
    }

    /// No motion.
    pub(crate) fn still(&self, kept: Kept) -> Motion {
        let of_span = |span: &Span| {
            let size = self.classes_of(span.line).iter().map(|class| class.size).sum();
            let directions = if kept == Kept::First { 1 } else { span.directions().len() };
            vec![Along::zeros(span.pieces().count(), size); directions]
        };
        let stations = Vector::zeros(self.stations());
        Motion { stations, spans: self.spans.iter().map(of_span).collect() }
    }

    /// Factors the assembly at one `s`: a cost that grows linearly with the sections. `None` if it is singular there.
    #[must_use]
    pub fn at(&self, s: Complex) -> Option<At<'_>> {
        let condensed = self.condensed(s);
        let factors = Lu::of(condensed.matrix())?;
        Some(At { condensed, s, factors })
    }

    /// The assembly at one `s`, not factored: a cost that grows linearly with the sections.
    #[must_use]
    pub fn condensed(&self, s: Complex) -> Condensed<'_> {
        let of_span = |(k, span): (usize, &Span)| {
            let directions = 0..span.directions().len();
            directions.map(|direction| self.chain(k, direction, s)).collect()
        };
        let chains = self.spans.iter().enumerate().map(of_span).collect();
        Condensed { assembly: self, s, chains }
    }

    /// The loads that a motion asks for: each coefficient times what `of` makes of it, and the matrices of the stations
    /// times `stations`.
    fn loads(
        &self,
        x: &Motion,
        of: impl Fn(&Coefficients) -> [Complex; TERMS],
        [stiffness, damping, mass]: [Complex; 3],
        side: Side,
    ) -> Motion {
        let entry = |i: usize, j: usize| {
            self.stiffness[i][j] * stiffness + self.damping[i][j] * damping + self.mass[i][j] * mass
        };
        let n = self.stations();
        let stations = Vector::from_fn(n, |i| {
            let at = |j: usize| if side == Side::Right { entry(i, j) } else { entry(j, i) };
            (0..n).map(|j| at(j) * x.stations[j]).sum()
        });
        let spans = self.spans.iter().zip(&x.spans).enumerate().map(|(index, (span, x))| {
            let each = x.iter().zip(&self.coefficients[index]).map(|(x, coefficients)| {
                let classes = self.classes_of(span.line);
                let k: Vec<[Complex; TERMS]> = coefficients.iter().map(&of).collect();
                let mut on = Along::zeros(x.nodes.len() - 1, x.size);
                for ((kind, x), on) in self.pieces(index).zip(x.elements()).zip(on.inner.chunks_exact_mut(x.size)) {
                    loads(classes, &k[kind], x, on);
                }
                on
            });
            each.collect()
        });
        Motion { stations, spans: spans.collect() }
    }

    /// `P'(s) x`, as loads.
    pub(crate) fn slope_loads(&self, x: &Motion, s: Complex, side: Side) -> Motion {
        self.loads(x, |k| slope_at(k, s), [Complex::ZERO, Complex::new(1.0, 0.0), 2.0 * s], side)
    }

    /// `(s M + C) x + M v`, as loads.
    pub(crate) fn momentum(&self, x: &Motion, v: &Motion, s: Complex) -> Motion {
        let (one, zero) = (Complex::new(1.0, 0.0), Complex::ZERO);
        let mut sum = self.loads(x, |k| k.map(|[_, b, c]| b + s * c), [zero, one, s], Side::Right);
        sum.add(one, &self.loads(v, |k| k.map(|[.., c]| c), [zero, zero, one], Side::Right));
        sum
    }

    /// The derivative of `left^T (s^2 M + s C + K) right` by `s`: of what is at the stations.
    #[must_use]
    pub fn slope_of_stations(&self, left: &[Complex], s: Complex, right: &[Complex]) -> Complex {
        let rows = self.mass.iter().zip(self.damping.iter()).zip(left);
        let of_row = |((mass, damping), left): ((&[f64], &[f64]), &Complex)| {
            let entries = mass.iter().zip(damping).zip(right);
            left * entries.map(|((m, c), right)| (c + 2.0 * s * m) * right).sum::<Complex>()
        };
        rows.map(of_row).sum()
    }
}

impl<'a> Condensed<'a> {
    /// `T(s)`.
    #[must_use]
    pub fn matrix(&self) -> Matrix<Complex> {
        let own = self.assembly;
        let [mut matrix, _] = own.of_stations(self.s);
        for (span, chains) in own.spans.iter().zip(self.chains.iter()) {
            for (direction, chain) in span.directions().iter().zip(chains) {
                span.add_blocks(*direction, &chain.ends, &mut matrix);
            }
        }
        matrix
    }

    /// The motion in which the stations move like this and nothing loads what is between them.
    #[must_use]
    pub fn motion(&self, stations: &[Complex]) -> Motion {
        self.spread_from(stations, Side::Right)
    }

    /// The weights of all equations whose sum has no other unknowns than those of the stations, with these weights there.
    #[must_use]
    pub fn weights(&self, stations: &[Complex]) -> Motion {
        self.spread_from(stations, Side::Left)
    }

    fn spread_from(&self, stations: &[Complex], side: Side) -> Motion {
        let mut motion = self.assembly.still(Kept::All);
        motion.stations = stations.into();
        self.spread(&mut motion, side);
        motion
    }

    /// Loads everywhere as loads on the stations; what remains within is reduced in place, for [`Self::spread`].
    fn reduced(&self, mut loads: Motion, side: Side) -> Motion {
        for ((span, chains), within) in self.assembly.spans.iter().zip(self.chains.iter()).zip(&mut loads.spans) {
            let ends: Vec<[Node; 2]> = chains.iter().zip(within).map(|(chain, loads)| chain.reduce(loads)).collect();
            span.add_loads(&ends, side, &mut loads.stations);
        }
        loads
    }

    /// Turns reduced loads between the stations into the motion there.
    fn spread(&self, motion: &mut Motion, side: Side) {
        for ((span, chains), own) in self.assembly.spans.iter().zip(self.chains.iter()).zip(&mut motion.spans) {
            let ends = span.ends_of(&motion.stations, side);
            for ((chain, ends), along) in chains.iter().zip(ends).zip(own) {
                chain.motion(ends, along);
            }
        }
    }
}

impl At<'_> {
    /// The motion under loads on the stations.
    #[must_use]
    pub fn response(&self, loads: &[Complex]) -> Motion {
        self.between(self.factors.solve(loads))
    }

    /// The motion in which the stations move like this and nothing loads what is between them.
    pub(crate) fn between(&self, stations: Vector<Complex>) -> Motion {
        self.condensed.motion(&stations)
    }

    /// The weights of all equations whose sum has no other unknowns than those of the stations, with these factors there:
    /// the same motion for the transposed equations.
    #[must_use]
    pub fn adjoint(&self, factors: &[Complex]) -> Motion {
        self.condensed.weights(&self.factors.solve_transposed(factors))
    }

    /// The phase of the determinant of all equations.
    pub(crate) fn phase(&self) -> Complex {
        let spans = self.condensed.assembly.spans.iter().zip(self.condensed.chains.iter());
        let within = spans.flat_map(|(span, chains)| chains.iter().map(|chain| chain.phase(span.components())));
        within.product::<Complex>() * self.factors.phase_of_determinant()
    }

    /// [`Self::solve`] for real loads at a real `s`, of which the first direction alone is kept.
    pub(crate) fn solve_real(&self, mut loads: Motion) -> Motion {
        let spans = self.condensed.assembly.spans.iter().zip(self.condensed.chains.iter());
        for ((span, chains), within) in spans.zip(&mut loads.spans) {
            let ends: Vec<[Node; 2]> = chains.iter().zip(within).map(|(chain, loads)| chain.reduce(loads)).collect();
            let mut on = Vector::zeros(loads.stations.len());
            span.add_loads(&ends, Side::Right, &mut on);
            let directions = span.directions().len() as f64;
            loads.stations.iter_mut().zip(&on).for_each(|(to, load)| *to += directions * load.re);
        }
        loads.stations = self.factors.solve(&loads.stations);
        loads.stations.iter_mut().for_each(|x| x.im = 0.0);
        self.condensed.spread(&mut loads, Side::Right);
        loads
    }

    /// Turns loads everywhere into the motion under them.
    pub(crate) fn solve(&self, loads: Motion, side: Side) -> Motion {
        let mut loads = self.condensed.reduced(loads, side);
        loads.stations = match side {
            Side::Right => self.factors.solve(&loads.stations),
            Side::Left => self.factors.solve_transposed(&loads.stations),
        };
        self.condensed.spread(&mut loads, side);
        loads
    }
}
