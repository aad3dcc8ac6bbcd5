//! One element: its inner unknowns eliminated, class by class.

use eigentol_numerics::Complex;

use crate::basis::{Class, Entry, MOST, SIGNS};
use crate::number::Number;
use crate::section::TERMS;

/// A block between two nodes.
pub(crate) type Block<T = Complex> = [[T; 2]; 2];
/// The blocks between two ends.
pub(crate) type Ends<T = Complex> = [[Block<T>; 2]; 2];
/// The unknowns of a node: deflection and slope, or one of a bar.
pub(crate) type Node<T = Complex> = [T; 2];

/// The largest number of unknowns of a class.
const SIZE: usize = MOST + 1;
/// That of degree 4.
const SMALL: usize = 5;

/// The number of unknowns of a node, and what the slope there is multiplied by to be one on `[-1, 1]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) components: usize,
    pub(crate) slope: f64,
}

/// An element at one `s` with its inner unknowns eliminated. Its unknowns are those of its two classes, one after the
/// other, nodal unknowns first in each.
#[derive(Clone, Debug)]
pub(crate) struct Element<T = Complex> {
    /// Between the two nodes.
    pub(crate) blocks: Ends<T>,
    /// Class by class for each inner unknown `p`: the inverse of its pivot, then the share of each unknown before it in
    /// `x_p = r_p / pivot_p - sum_j<p share_pj x_j`.
    factors: Vec<T>,
    sizes: [usize; 2],
    shape: Shape,
}

impl Shape {
    /// Half of what a nodal unknown is multiplied by.
    fn half(self, component: usize) -> f64 {
        if component == 1 { 0.5 * self.slope } else { 0.5 }
    }

    /// A nodal unknown of a class, from those of the two nodes.
    #[inline(always)]
    fn amplitude<T: Number>(self, class: usize, component: usize, nodes: [Node<T>; 2]) -> T {
        let [first, second] = SIGNS[class][component];
        (nodes[0][component].times(first) + nodes[1][component].times(second)).times(self.half(component))
    }
}

impl<T: Number> Element<T> {
    #[inline(always)]
    pub(crate) fn new(classes: &[Class; 2], shape: Shape, k: &[T; TERMS]) -> Self {
        let mut factors = Vec::with_capacity(32);
        let slope = (shape.slope != 1.0).then(|| T::of(shape.slope.into()));
        let blocks = blocks(classes, (shape.components, slope), k, Some(&mut factors));
        Self { blocks, factors, sizes: [classes[0].size, classes[1].size], shape }
    }

    /// All unknowns of the element from those of its nodes; `own` holds reduced loads on the inner ones.
    #[inline(always)]
    pub(crate) fn unknowns(&self, nodes: [Node<T>; 2], own: &mut [T]) {
        let c = self.shape.components;
        let (mut start, mut row) = (0, 0);
        for (class, size) in self.sizes.into_iter().enumerate() {
            let x = &mut own[start..start + size];
            for (component, to) in x[..c].iter_mut().enumerate() {
                *to = self.shape.amplitude(class, component, nodes);
            }
            for p in c..size {
                let factors = &self.factors[row..row + p + 1];
                let mut value = x[p] * factors[0];
                for j in 0..p {
                    value -= factors[j + 1] * x[j];
                }
                x[p] = value;
                row += p + 1;
            }
            start += size;
        }
    }
}

impl Element {
    /// The phase of the determinant of what was eliminated.
    pub(crate) fn phase(&self) -> Complex {
        let mut phase = Complex::new(1.0, 0.0);
        let mut factors = &self.factors[..];
        for size in self.sizes {
            for p in self.shape.components..size {
                phase = turned(phase, factors[0].conj());
                factors = &factors[p + 1..];
            }
        }
        phase
    }

    /// Loads on the nodes that do as loads on all unknowns; what acts on the inner ones is reduced in place, for
    /// [`Self::unknowns`].
    pub(crate) fn reduce(&self, own: &mut [Complex]) -> [Node; 2] {
        let c = self.shape.components;
        let mut nodes = [[Complex::ZERO; 2]; 2];
        let (mut rest, mut factors) = (own, &self.factors[..]);
        for (class, size) in self.sizes.into_iter().enumerate() {
            let (loads, others) = rest.split_at_mut(size);
            let count: usize = (c..size).map(|p| p + 1).sum();
            let (mut rows, next) = factors.split_at(count);
            for p in (c..size).rev() {
                let (before, row) = rows.split_at(rows.len() - p - 1);
                let load = loads[p];
                for (to, share) in loads.iter_mut().zip(&row[1..]) {
                    *to -= share * load;
                }
                rows = before;
            }
            for component in 0..c {
                let load = loads[component] * self.shape.half(component);
                for (node, sign) in nodes.iter_mut().zip(SIGNS[class][component]) {
                    node[component] += load * sign;
                }
            }
            (rest, factors) = (others, next);
        }
        nodes
    }
}

/// A phase turned by that of a number.
pub(crate) fn turned(phase: Complex, by: Complex) -> Complex {
    phase * by / by.norm()
}

/// The blocks between the nodes of an element whose inner unknowns are eliminated, class by class. `keep` gets the factors of
/// each class. Of the nodes: the number of unknowns, and what the slope there is multiplied by to be one on `[-1, 1]`, if it is not.
#[inline(always)]
pub(crate) fn blocks<T: Number>(
    classes: &[Class; 2],
    (c, slope): (usize, Option<T>),
    k: &[T; TERMS],
    mut keep: Option<&mut Vec<T>>,
) -> Ends<T> {
    let mut blocks = [[[[T::zero(); 2]; 2]; 2]; 2];
    for (number, class) in classes.iter().enumerate() {
        let nodal = if class.size <= SMALL {
            eliminated::<T, SMALL, { SMALL * (SMALL + 1) / 2 }>(class, c, k, keep.as_deref_mut())
        } else {
            eliminated::<T, SIZE, { SIZE * (SIZE + 1) / 2 }>(class, c, k, keep.as_deref_mut())
        };
        for a in 0..c {
            for b in 0..c {
                let mut value = nodal[a][b].times(0.25);
                if let Some(slope) = slope {
                    for _ in 0..a + b {
                        value = value * slope;
                    }
                }
                let (first, second) = (&SIGNS[number][a], &SIGNS[number][b]);
                for p in 0..2 {
                    for q in 0..2 {
                        blocks[p][q][a][b] += value.times(first[p] * second[q]);
                    }
                }
            }
        }
    }
    blocks
}

/// Eliminates the inner unknowns of a class, the last first; its matrix is symmetric, and what is on the diagonal and below has
/// room. Returns the block of the nodal ones; `keep` gets for each inner unknown `p`, the first first, the inverse of its pivot
/// and the share of each before it.
#[inline(always)]
fn eliminated<T: Number, const ROOM: usize, const ENTRIES: usize>(
    class: &Class,
    components: usize,
    k: &[T; TERMS],
    mut keep: Option<&mut Vec<T>>,
) -> Block<T> {
    let n = class.size;
    let place = |i: usize, j: usize| i * (i + 1) / 2 + j;
    let mut all = [T::zero(); ENTRIES];
    for entry in &class.entries {
        all[place(entry.row, entry.column)] = entry.value(k);
    }
    if let Some(keep) = &mut keep {
        let more = (components..n).map(|p| p + 1).sum::<usize>();
        keep.resize(keep.len() + more, T::zero());
    }
    let mut end = keep.as_ref().map_or(0, |keep| keep.len());
    let mut shares = [T::zero(); ROOM];
    for p in (components..n).rev() {
        let inverse = all[place(p, p)].inverse();
        for j in 0..p {
            shares[j] = all[place(p, j)] * inverse;
        }
        for i in 0..p {
            for j in 0..=i {
                let from = all[place(p, j)];
                all[place(i, j)] -= shares[i] * from;
            }
        }
        if let Some(keep) = &mut keep {
            end -= p + 1;
            keep[end] = inverse;
            keep[end + 1..=end + p].copy_from_slice(&shares[..p]);
        }
    }
    let [first, mixed, second] =
        [0, 1, 2].map(|place| if place == 0 || components == 2 { all[place] } else { T::zero() });
    [[first, mixed], [mixed, second]]
}

/// `left^T Q x` for each constant matrix.
#[inline(always)]
pub(crate) fn forms<T: Number>(classes: &[Class; 2], left: &[T], right: &[T]) -> [T; TERMS] {
    let mut forms = [T::zero(); TERMS];
    let mut start = 0;
    for class in classes {
        let (left, right) = (&left[start..], &right[start..]);
        for Entry { row, column, terms } in &class.entries {
            let mut product = left[*row] * right[*column];
            if row != column {
                product += left[*column] * right[*row];
            }
            for &(term, value) in terms {
                forms[term] += product.times(value);
            }
        }
        start += class.size;
    }
    forms
}

/// Loads on all unknowns: the sum of the constant matrices times their coefficients, on a motion.
#[inline(always)]
pub(crate) fn loads<T: Number>(classes: &[Class; 2], k: &[T; TERMS], x: &[T], loads: &mut [T]) {
    let mut start = 0;
    for class in classes {
        let (x, loads) = (&x[start..], &mut loads[start..]);
        for entry in &class.entries {
            let (i, j, factor) = (entry.row, entry.column, entry.value(k));
            loads[i] += factor * x[j];
            if i != j {
                loads[j] += factor * x[i];
            }
        }
        start += class.size;
    }
}
