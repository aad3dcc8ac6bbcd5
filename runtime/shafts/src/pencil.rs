//! `T(s)` with its derivative at several `s` side by side in the vectors of the processor.

use eigentol_contract::scalar::{Batch, Dual, Instructions, Lanes, Real, Task, WIDTH};
use eigentol_numerics::algebra::{Vector, dot_complex};
use eigentol_numerics::{Complex, Matrix};

use crate::assembly::Assembly;
use crate::chain::joined;
use crate::element::{Ends, blocks};
use crate::number::{Number, Pair};
use crate::section::at;

/// Distance from a pole as a part of `s`, below which motions are sought beside it.
const NEXT: f64 = 1e-5;
/// How far.
const BESIDE: f64 = 1e-6;

/// `T` and its derivative at one `s`.
#[derive(Clone, Debug)]
pub struct Pencil {
    /// 1/s.
    pub s: Complex,
    /// `T(s)`.
    pub matrix: Matrix<Complex>,
    /// `T'(s)`.
    pub slope: Matrix<Complex>,
}

/// One number of each lane: real and imaginary part, and their derivatives by `s`.
type Four = [Batch; 4];
/// The entries between the ends of a chain, one after the other.
type Entries = [Four; 16];

impl Assembly {
    /// `T` and its derivative at each of these `s`; the bits of each are the same whatever stands beside it.
    #[must_use]
    pub fn pencils(&self, all: &[Complex]) -> Vec<Pencil> {
        let mut pencils = Vec::with_capacity(all.len());
        for group in all.chunks(WIDTH) {
            let at = |of: fn(&Complex) -> f64| Batch::from_fn(|lane| of(group.get(lane).unwrap_or(&group[0])));
            let s = [at(|s| s.re), at(|s| s.im)];
            let found = Instructions::best().run(Condense { assembly: self, count: group.len(), s: &s });
            for (lane, &s) in group.iter().enumerate() {
                let [mut matrix, mut slope] = self.of_stations(s);
                let mut chains = found.iter();
                for span in self.spans() {
                    for (direction, entries) in span.directions().iter().zip(chains.by_ref()) {
                        span.add_blocks(*direction, &ends(entries, lane, 0), &mut matrix);
                        span.add_blocks(*direction, &ends(entries, lane, 2), &mut slope);
                    }
                }
                pencils.push(Pencil { s, matrix, slope });
            }
        }
        pencils
    }
}

impl Assembly {
    /// The same, beside an `s` next to a pole: a span between stations that stand still vibrates there, and of a free one these may be
    /// frequencies too. The motions of a mode, each an eigenvector of `T` itself, change as little as `s` does.
    pub(crate) fn regular(&self, all: &[Complex]) -> Vec<Pencil> {
        let mut pencils = self.pencils(all);
        for pencil in &mut pencils {
            if self.poles(pencil) > 1.0 / NEXT {
                let both = self.pencils(&[1.0 - BESIDE, 1.0 + BESIDE].map(|part| pencil.s * part));
                let less = both.into_iter().min_by(|a, b| self.poles(a).total_cmp(&self.poles(b)));
                *pencil = less.unwrap_or_else(|| pencil.clone());
            }
        }
        pencils
    }

    /// How much more spans resist their ends than they do far from a pole and than what is at the station, the most of all.
    pub(crate) fn poles(&self, pencil: &Pencil) -> f64 {
        let mut most: f64 = 0.0;
        for span in self.spans() {
            let usual = span.usual(pencil.s.norm());
            for (k, place) in span.ends.iter().flat_map(|end| end.iter().enumerate()) {
                let Some((unknown, _)) = *place else { continue };
                let of_station = self.of_station(unknown, pencil.s);
                let of_spans = pencil.matrix[unknown][unknown] - of_station;
                let own = of_spans.norm() / (usual[k % 2] + of_station.norm());
                most = if own.is_finite() { most.max(own) } else { f64::INFINITY };
            }
        }
        most
    }
}

impl Pencil {
    /// What is solved with to have a motion and weights nearer to those of a mode: with as much as the change of `s` makes, and next
    /// to a pole, whose that is there, with themselves.
    pub(crate) fn loads(&self, next_to_pole: bool, right: &[Complex], left: &[Complex]) -> [Vector<Complex>; 2] {
        if next_to_pole {
            return [right.into(), left.into()];
        }
        [times(&self.slope, right), times_transposed(&self.slope, left)]
    }
}

pub(crate) fn times(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    matrix.iter().map(|row: &[Complex]| dot_complex(row, x)).collect()
}

fn times_transposed(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    let mut sum = Vector::zeros(matrix.column_count());
    for (row, x) in matrix.iter().zip(x) {
        sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += x * value);
    }
    sum
}

/// The blocks of one lane: from the given number of [`Four`] on.
fn ends(entries: &Entries, lane: usize, part: usize) -> Ends {
    let entry = |p: usize, q: usize, a: usize, b: usize| {
        let four = &entries[8 * p + 4 * q + 2 * a + b];
        Complex::new(four[part].0[lane], four[part + 1].0[lane])
    };
    let block = |p: usize, q: usize| [0, 1].map(|a| [0, 1].map(|b| entry(p, q, a, b)));
    [0, 1].map(|p| [0, 1].map(|q| block(p, q)))
}

/// The blocks between the ends of each span in each direction.
struct Condense<'a> {
    assembly: &'a Assembly,
    count: usize,
    s: &'a [Batch; 2],
}

impl Task for Condense<'_> {
    type Output = Vec<Entries>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Vec<Entries> {
        let Self { assembly, count, s } = self;
        let chains: usize = assembly.spans().iter().map(|span| span.directions().len()).sum();
        let mut all = vec![[[Batch::default(); 4]; 16]; chains];
        for at in (0..count).step_by(V::WIDTH) {
            let s = Pair {
                re: Dual { value: V::load(&s[0], at), slope: V::constant(1.0) },
                im: Dual { value: V::load(&s[1], at), slope: V::constant(0.0) },
            };
            let mut k = 0;
            for span in 0..assembly.spans().len() {
                for direction in 0..assembly.spans()[span].directions().len() {
                    let found = between(assembly, span, direction, s);
                    for p in 0..2 {
                        for q in 0..2 {
                            for a in 0..2 {
                                for b in 0..2 {
                                    let (from, to) = (found[p][q][a][b], &mut all[k][8 * p + 4 * q + 2 * a + b]);
                                    from.re.value.store(&mut to[0], at);
                                    from.im.value.store(&mut to[1], at);
                                    from.re.slope.store(&mut to[2], at);
                                    from.im.slope.store(&mut to[3], at);
                                }
                            }
                        }
                    }
                    k += 1;
                }
            }
        }
        all
    }
}

/// The blocks between the ends of a span.
#[inline(always)]
fn between<R: Real>(assembly: &Assembly, span: usize, direction: usize, s: Pair<R>) -> Ends<Pair<R>> {
    let own = &assembly.spans()[span];
    let (classes, components) = (assembly.classes_of(own.line), own.components());
    let mut elements = Vec::with_capacity(own.sections.len());
    for (section, coefficients) in assembly.different(span, direction) {
        let slope = own.slope_is_length().then(|| Pair::of(own.shape(section).slope.into()));
        elements.push(blocks(classes, (components, slope), &at(coefficients, s), None));
    }
    let mut pieces = assembly.pieces(span);
    let mut ends = elements[pieces.next().unwrap_or_default()];
    for piece in pieces {
        ends = joined(ends, &elements[piece], components).0;
    }
    ends
}
