//! Forms of motions at several `s` side by side in the vectors of the processor: how they change with what describes the spans.

use eigentol_contract::scalar::{Batch, Instructions, Lanes, Task, WIDTH};
use eigentol_numerics::Complex;

use crate::assembly::Assembly;
use crate::basis::Class;
use crate::chain::{Along, Chain};
use crate::element::{Element, Node, forms, loads};
use crate::motion::Side;
use crate::number::{Number as Field, Pair};
use crate::section::{Line, Number, TERMS, at, slope_at};
use crate::span::Span;

/// `left^T T(s) right` of two vectors of the stations.
#[derive(Clone, Copy, Debug)]
pub struct Form<'a> {
    /// Weights of the equations of the stations.
    pub left: &'a [Complex],
    /// 1/s.
    pub s: Complex,
    /// A motion of the stations.
    pub right: &'a [Complex],
}

/// What a span has to do with a form.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanForm {
    /// Derivative by `s`.
    pub rate: Complex,
    /// By the speed of the span.
    pub speed: Complex,
    /// By the numbers of each section, in the order of [`Number::ALL`].
    pub sections: Vec<[Complex; Number::ALL.len()]>,
}

/// Real and imaginary part of one number of each lane.
type Two = [Batch; 2];
/// Of the left and of the right side: the unknowns of both ends.
type Sides = [[[Two; 2]; 2]; 2];
/// The numbers of a span that belong to no section.
const OWN: usize = 2;

impl Assembly {
    /// Derivatives of each form by what describes each span; the bits of each are the same whatever stands beside it. With the
    /// opposite sign, they are those of what [`At::adjoint`](crate::At::adjoint) weighs in a response.
    #[must_use]
    pub fn gradients(&self, all: &[Form<'_>]) -> Vec<Vec<SpanForm>> {
        self.of_forms::<true, _>(all, |[rate, speed], sections| SpanForm { rate, speed, sections })
    }

    /// Of the motion of each form twice the amplitude of the kinetic energy of each span over the square of its frequency: in
    /// `y + i z` and in `y - i z`, of a bar the first alone. SI.
    #[must_use]
    pub fn inertia(&self, all: &[Form<'_>]) -> Vec<Vec<[f64; 2]>> {
        self.of_forms::<false, _>(all, |own, _| own.map(|own| own.re))
    }

    fn of_forms<const GRADIENT: bool, R>(
        &self,
        all: &[Form<'_>],
        of_span: impl Fn([Complex; OWN], Vec<[Complex; Number::ALL.len()]>) -> R,
    ) -> Vec<Vec<R>> {
        let mut found = Vec::with_capacity(all.len());
        for group in all.chunks(WIDTH) {
            let (s, sides) = (two(|lane| group.get(lane).unwrap_or(&group[0]).s), self.sides(group));
            let task = OfForms::<'_, GRADIENT> { assembly: self, count: group.len(), s: &s, sides: &sides };
            let numbers = Instructions::best().run(task);
            found.extend((0..group.len()).map(|lane| {
                let mut numbers = numbers.iter().map(|number| Complex::new(number[0].0[lane], number[1].0[lane]));
                let mut next = || numbers.next().unwrap_or_default();
                let each = self.spans().iter().map(|span| {
                    let (own, sections) = (core::array::from_fn(|_| next()), rows::<GRADIENT>(span));
                    of_span(own, (0..sections).map(|_| core::array::from_fn(|_| next())).collect())
                });
                each.collect()
            }));
        }
        found
    }

    /// The ends of each span in each direction.
    fn sides(&self, group: &[Form<'_>]) -> Vec<Sides> {
        let mut sides = Vec::new();
        for span in self.spans() {
            let of_form = |form: &Form<'_>| {
                [(form.left, Side::Left), (form.right, Side::Right)]
                    .map(|(stations, side)| span.ends_of(stations, side))
            };
            let ends: Vec<[Vec<[Node; 2]>; 2]> = group.iter().map(of_form).collect();
            let lane = |lane: usize| ends.get(lane).unwrap_or(&ends[0]);
            for direction in 0..span.directions().len() {
                let unknown = |side: usize, end: usize, k: usize| two(|own| lane(own)[side][direction][end][k]);
                sides.push([0, 1].map(|side| [0, 1].map(|end| [0, 1].map(|k| unknown(side, end, k)))));
            }
        }
        sides
    }
}

/// The number of sections of a span that have numbers of their own.
fn rows<const GRADIENT: bool>(span: &Span) -> usize {
    if GRADIENT { span.sections.len() } else { 0 }
}

fn two(of: impl Fn(usize) -> Complex) -> Two {
    [Batch::from_fn(|lane| of(lane).re), Batch::from_fn(|lane| of(lane).im)]
}

/// The numbers of each span, one after the other: derivatives, or inertia.
struct OfForms<'a, const GRADIENT: bool> {
    assembly: &'a Assembly,
    count: usize,
    s: &'a Two,
    sides: &'a [Sides],
}

impl<const GRADIENT: bool> Task for OfForms<'_, GRADIENT> {
    type Output = Vec<Two>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Vec<Two> {
        let Self { assembly, count, s, sides } = self;
        let of_span = |span: &Span| OWN + Number::ALL.len() * rows::<GRADIENT>(span);
        let mut all = vec![[Batch::default(); 2]; assembly.spans().iter().map(of_span).sum()];
        for at in (0..count).step_by(V::WIDTH) {
            let s = load::<V>(s, at);
            let (mut first, mut chain) = (0, 0);
            for (index, span) in assembly.spans().iter().enumerate() {
                let mut numbers = vec![Pair::<V>::zero(); of_span(span)];
                for direction in 0..span.directions().len() {
                    of_chain::<V, GRADIENT>(assembly, [index, direction], s, (&sides[chain], at), &mut numbers);
                    chain += 1;
                }
                for (to, number) in all[first..].iter_mut().zip(&numbers) {
                    number.re.store(&mut to[0], at);
                    number.im.store(&mut to[1], at);
                }
                first += numbers.len();
            }
        }
        all
    }
}

#[inline(always)]
fn load<V: Lanes>(from: &Two, at: usize) -> Pair<V> {
    Pair { re: V::load(&from[0], at), im: V::load(&from[1], at) }
}

/// Adds what a span has to do with the forms in one direction.
#[inline(always)]
fn of_chain<V: Lanes, const GRADIENT: bool>(
    assembly: &Assembly,
    [index, direction]: [usize; 2],
    s: Pair<V>,
    (sides, lane): (&Sides, usize),
    numbers: &mut [Pair<V>],
) {
    let span = &assembly.spans()[index];
    let classes = assembly.classes_of(span.line);
    let (mut kinds, mut elements) = (Vec::new(), Vec::new());
    for (section, coefficients) in assembly.different(index, direction) {
        let k = at(coefficients, s);
        elements.push(Element::new(classes, span.shape(section), &k));
        kinds.push((coefficients, k, slope_at(coefficients, s)));
    }
    let pieces: Vec<usize> = assembly.pieces(index).collect();
    let (count, size) = (pieces.len(), classes[0].size + classes[1].size);
    let chain = Chain::new(elements, pieces, span.components());
    let mut right = Along::zeros(count, size);
    chain.motion(ends(&sides[1], lane), &mut right);
    if !GRADIENT {
        let mut mirrored = vec![Pair::zero(); size];
        for (piece, section) in span.pieces().enumerate() {
            let right = &right.inner[piece * size..(piece + 1) * size];
            for (to, x) in mirrored.iter_mut().zip(right) {
                *to = Pair { re: x.re, im: -x.im };
            }
            let mut mass = [Pair::zero(); TERMS];
            for (to, [_, _, own]) in mass.iter_mut().zip(kinds[assembly.kind(index, section)].0) {
                *to = Pair::of(*own);
            }
            numbers[direction] += product(&mass, &forms(classes, &mirrored, right));
        }
        return;
    }
    let mut left = Along::zeros(count, size);
    chain.motion(ends(&sides[0], lane), &mut left);
    for (piece, section) in span.pieces().enumerate() {
        let own = piece * size..(piece + 1) * size;
        let (left, right) = (&left.inner[own.clone()], &right.inner[own]);
        let all = forms(classes, left, right);
        let kind = assembly.kind(index, section);
        let (_, k, slope) = &kinds[kind];
        numbers[0] += product(slope, &all);
        let row = OWN + Number::ALL.len() * section;
        // Elements share the length of their section.
        let (element, share) = (span.element(section), 1.0 / span.sections[section].1 as f64);
        let all = element.slopes((span.line, span.speed, span.directions()[direction]), s, k, &all);
        numbers[row] += all[0].times(share);
        for (to, slope) in numbers[row + 1..].iter_mut().zip(&all[1..Number::ALL.len()]) {
            *to += *slope;
        }
        numbers[1] += all[Number::ALL.len()];
        if span.line == Line::Slender {
            // The slopes at the nodes, times half the length, are unknowns of the element.
            let by_slope = at_slope(classes, k, left, right) + at_slope(classes, k, right, left);
            numbers[row] += by_slope.times(share / element.length);
        }
    }
}

#[inline(always)]
fn ends<V: Lanes>(ends: &[[Two; 2]; 2], at: usize) -> [Node<Pair<V>>; 2] {
    let [[a, b], [c, d]] = ends;
    [[load(a, at), load(b, at)], [load(c, at), load(d, at)]]
}

#[inline(always)]
fn product<V: Lanes>(k: &[Pair<V>; TERMS], forms: &[Pair<V>; TERMS]) -> Pair<V> {
    let mut sum = Pair::zero();
    for (k, form) in k.iter().zip(forms) {
        sum += *k * *form;
    }
    sum
}

/// The loads on the slopes of the nodes in one motion times these slopes in another.
#[inline(always)]
fn at_slope<V: Lanes>(classes: &[Class; 2], k: &[Pair<V>; TERMS], a: &[Pair<V>], b: &[Pair<V>]) -> Pair<V> {
    let mut on = vec![Pair::zero(); a.len()];
    loads(classes, k, a, &mut on);
    let second = classes[0].size + 1;
    on[1] * b[1] + on[second] * b[second]
}
