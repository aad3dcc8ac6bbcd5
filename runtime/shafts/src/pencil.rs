//! `T(s)` with its derivative at several `s` side by side in the vectors of the processor.

use eigentol_contract::scalar::{Batch, Dual, Instructions, Lanes, Real, Task, WIDTH};
use eigentol_numerics::{Complex, Matrix};

use crate::assembly::Assembly;
use crate::chain::joined;
use crate::element::{Ends, blocks};
use crate::number::{Number, Pair};
use crate::section::at;

/// `T` and its derivative at one `s`.
#[derive(Clone, Debug)]
pub struct Pencil {
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
                pencils.push(Pencil { matrix, slope });
            }
        }
        pencils
    }
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
