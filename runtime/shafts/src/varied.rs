//! How the spans change when their numbers and `s` do: derivatives along two directions and the mixed one, by dual numbers, of
//! several changes side by side in the vectors of the processor.

use eigentol_contract::scalar::{Batch, Dual, Instructions, Lanes, Real, Task, WIDTH};
use eigentol_numerics::{Complex, Matrix};

use crate::assembly::Assembly;
use crate::chain::joined;
use crate::element::{Ends, blocks};
use crate::number::{Number as Field, Pair};
use crate::section::{Number, TERMS, coefficients};

/// The inertia of a slope of a uniform span, as a part of its mass times the square of its length.
pub const LUMPED: f64 = 1.0 / 52.5;

/// A number that changes along two directions.
pub type Second = Dual<Dual<f64>>;

/// Numbers of all spans, of each its speed and then those of its sections in the order of [`Number::ALL`], and `s` with its
/// imaginary part, as they change along two directions.
#[derive(Clone, Debug)]
pub struct Varied {
    /// Of the spans.
    pub numbers: Vec<Second>,
    /// 1/s.
    pub s: [Second; 2],
}

/// A matrix of the stations, its derivatives along the first and the second direction, and the mixed one.
pub type Changes = [Matrix<Complex>; 4];

/// The four parts of a number.
const PARTS: usize = 4;
/// Entries between the ends of a chain.
const ENTRIES: usize = 16;

/// Half the inertia of a span with these numbers, at a deflection and at a slope of an end.
#[inline(always)]
pub fn lumped<T: Real>(numbers: &[T]) -> [T; 2] {
    let [mut length, mut mass, mut rotary] = [T::constant(0.0); 3];
    for own in numbers[1..].chunks_exact(Number::ALL.len()) {
        length = length + own[Number::Length as usize];
        mass = mass + own[Number::Mass as usize] * own[Number::Length as usize];
        rotary = rotary + own[Number::Rotary as usize] * own[Number::Length as usize];
    }
    let turned = rotary + T::constant(LUMPED) * mass * length * length;
    [mass, turned].map(|x| T::constant(0.5) * x)
}

impl Assembly {
    /// `spans(s) - spans(0) - s^2 lumped` and its derivatives, for each of these changes; the bits of each are the same whatever
    /// stands beside it.
    #[must_use]
    pub fn varied(&self, all: &[Varied]) -> Vec<Changes> {
        let mut found = Vec::with_capacity(all.len());
        for group in all.chunks(WIDTH) {
            let batches = |of: &dyn Fn(&Varied) -> Second| -> [Batch; PARTS] {
                let number = |lane: usize| parts(of(group.get(lane).unwrap_or(&group[0])));
                core::array::from_fn(|part| Batch::from_fn(|lane| number(lane)[part]))
            };
            let numbers = (0..all[0].numbers.len()).map(|k| batches(&|own| own.numbers[k])).collect();
            let s = [0, 1].map(|part| batches(&|own| own.s[part]));
            let chains = Instructions::best().run(Vary { assembly: self, count: group.len(), numbers, s });
            found.extend((0..group.len()).map(|lane| {
                let n = self.stations();
                let mut changes = [(); PARTS].map(|()| Matrix::zeros(n, n));
                let mut chains = chains.iter();
                for span in self.spans() {
                    for (direction, chain) in span.directions().iter().zip(chains.by_ref()) {
                        for (part, to) in changes.iter_mut().enumerate() {
                            span.add_blocks(*direction, &ends(chain, lane, part), to);
                        }
                    }
                }
                changes
            }));
        }
        found
    }
}

fn parts(number: Second) -> [f64; PARTS] {
    [number.value.value, number.value.slope, number.slope.value, number.slope.slope]
}

/// The blocks of one lane of which one part.
fn ends(entries: &Entries, lane: usize, part: usize) -> Ends {
    let entry = |k: usize| Complex::new(entries[k][0][part].0[lane], entries[k][1][part].0[lane]);
    let block = |p: usize, q: usize| [0, 1].map(|a| [0, 1].map(|b| entry(8 * p + 4 * q + 2 * a + b)));
    [0, 1].map(|p| [0, 1].map(|q| block(p, q)))
}

/// The entries between the ends of a chain, one after the other, each with its real and imaginary part.
type Entries = [[[Batch; PARTS]; 2]; ENTRIES];

/// The blocks between the ends of each span in each direction.
struct Vary<'a> {
    assembly: &'a Assembly,
    count: usize,
    numbers: Vec<[Batch; PARTS]>,
    s: [[Batch; PARTS]; 2],
}

impl Task for Vary<'_> {
    type Output = Vec<Entries>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Vec<Entries> {
        let Self { assembly, count, numbers, s } = self;
        let chains: usize = assembly.spans().iter().map(|span| span.directions().len()).sum();
        let mut all = vec![[[[Batch::default(); PARTS]; 2]; ENTRIES]; chains];
        let mut loaded = Vec::with_capacity(numbers.len());
        for at in (0..count).step_by(V::WIDTH) {
            loaded.clear();
            for number in &numbers {
                loaded.push(load::<V>(number, at));
            }
            let s = Pair { re: load::<V>(&s[0], at), im: load::<V>(&s[1], at) };
            let (mut first, mut k) = (0, 0);
            for (index, span) in assembly.spans().iter().enumerate() {
                let count = 1 + Number::ALL.len() * span.sections.len();
                for direction in span.directions() {
                    let found = moving(assembly, index, *direction, &loaded[first..first + count], s);
                    for p in 0..2 {
                        for q in 0..2 {
                            for a in 0..2 {
                                for b in 0..2 {
                                    let (from, to) = (found[p][q][a][b], &mut all[k][8 * p + 4 * q + 2 * a + b]);
                                    store(from.re, &mut to[0], at);
                                    store(from.im, &mut to[1], at);
                                }
                            }
                        }
                    }
                    k += 1;
                }
                first += count;
            }
        }
        all
    }
}

#[inline(always)]
fn load<V: Lanes>(from: &[Batch; PARTS], at: usize) -> Dual<Dual<V>> {
    let dual = |k: usize| Dual { value: V::load(&from[k], at), slope: V::load(&from[k + 1], at) };
    Dual { value: dual(0), slope: dual(2) }
}

#[inline(always)]
fn store<V: Lanes>(from: Dual<Dual<V>>, to: &mut [Batch; PARTS], at: usize) {
    from.value.value.store(&mut to[0], at);
    from.value.slope.store(&mut to[1], at);
    from.slope.value.store(&mut to[2], at);
    from.slope.slope.store(&mut to[3], at);
}

/// The blocks between the ends of a span in motion, less those at rest and of the lumped inertia.
#[inline(always)]
fn moving<R: Real>(assembly: &Assembly, span: usize, direction: f64, numbers: &[R], s: Pair<R>) -> Ends<Pair<R>> {
    let mut moving = between(assembly, span, direction, numbers, s);
    let still = between(assembly, span, direction, numbers, Pair::zero());
    let inertia = lumped(numbers).map(|own| s * s * Pair { re: own, im: R::constant(0.0) });
    for p in 0..2 {
        for q in 0..2 {
            for a in 0..2 {
                for b in 0..2 {
                    moving[p][q][a][b] -= still[p][q][a][b];
                }
            }
        }
        for (k, own) in inertia.iter().enumerate().take(assembly.spans()[span].components()) {
            moving[p][p][k][k] -= *own;
        }
    }
    moving
}

/// The blocks between the ends of a span.
#[inline(always)]
fn between<R: Real>(assembly: &Assembly, span: usize, direction: f64, numbers: &[R], s: Pair<R>) -> Ends<Pair<R>> {
    let own = &assembly.spans()[span];
    let (classes, components) = (assembly.classes_of(own.line), own.components());
    let real = |re: R| Pair { re, im: R::constant(0.0) };
    let speed = real(numbers[0]).times(direction);
    let mut ends = [[[[Pair::zero(); 2]; 2]; 2]; 2];
    for (section, (_, pieces)) in own.sections.iter().enumerate() {
        let from = 1 + Number::ALL.len() * section;
        let mut section_numbers = [Pair::zero(); Number::ALL.len()];
        for (to, number) in section_numbers.iter_mut().zip(&numbers[from..]) {
            *to = real(*number);
        }
        let length = &mut section_numbers[Number::Length as usize];
        *length = length.times(1.0 / *pieces as f64);
        let slope = own.slope_is_length().then(|| length.times(0.5));
        let all = coefficients(own.line, &section_numbers, speed);
        let mut k = [Pair::zero(); TERMS];
        for (to, [a, b, c]) in k.iter_mut().zip(&all) {
            *to = *a + s * (*b + s * *c);
        }
        let element = blocks(classes, (components, slope), &k, None);
        for piece in 0..*pieces {
            ends = if section == 0 && piece == 0 { element } else { joined(ends, &element, components).0 };
        }
    }
    ends
}
