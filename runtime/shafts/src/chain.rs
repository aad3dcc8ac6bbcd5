//! Elements in series: inner nodes eliminated from one end to the other.

use eigentol_numerics::Complex;

use crate::element::{Block, Element, Ends, Node, turned};
use crate::number::Number;

/// A series of elements at one `s`, with all but its two end nodes eliminated.
#[derive(Clone, Debug)]
pub(crate) struct Chain<T = Complex> {
    elements: Vec<Element<T>>,
    /// Which element each piece is.
    pieces: Vec<usize>,
    inner: Vec<Eliminated<T>>,
    /// Between the end nodes.
    pub(crate) ends: Ends<T>,
}

/// An eliminated node: the inverse of its own block, and its block with the first node.
#[derive(Clone, Debug)]
pub(crate) struct Eliminated<T = Complex> {
    inverse: Block<T>,
    with_first: Block<T>,
}

/// The motion of a series of elements, or loads on it.
#[derive(Clone, Debug)]
pub(crate) struct Along<T = Complex> {
    pub(crate) nodes: Vec<Node<T>>,
    /// Element by element.
    pub(crate) inner: Vec<T>,
    /// The number of unknowns of an element.
    pub(crate) size: usize,
}

impl<T: Number> Along<T> {
    #[inline(always)]
    pub(crate) fn zeros(pieces: usize, size: usize) -> Self {
        Self { nodes: vec![[T::zero(); 2]; pieces + 1], inner: vec![T::zero(); pieces * size], size }
    }

    pub(crate) fn elements(&self) -> impl Iterator<Item = &[T]> {
        self.inner.chunks_exact(self.size)
    }
}

impl<T: Number> Chain<T> {
    /// `pieces` names the element of each piece.
    #[inline(always)]
    pub(crate) fn new(elements: Vec<Element<T>>, pieces: Vec<usize>, components: usize) -> Self {
        let mut ends = elements[pieces[0]].blocks;
        let mut inner = Vec::with_capacity(pieces.len() - 1);
        for &piece in &pieces[1..] {
            let (next, node) = joined(ends, &elements[piece].blocks, components);
            ends = next;
            inner.push(node);
        }
        Self { elements, pieces, inner, ends }
    }

    /// Turns loads that were reduced into the motion of everything between two ends.
    #[inline(always)]
    pub(crate) fn motion(&self, ends: [Node<T>; 2], along: &mut Along<T>) {
        let count = self.pieces.len();
        (along.nodes[0], along.nodes[count]) = (ends[0], ends[1]);
        for k in (0..self.inner.len()).rev() {
            let Eliminated { inverse, with_first } = &self.inner[k];
            let [[_, across], _] = &self.elements[self.pieces[k + 1]].blocks;
            let by_first = apply(&transposed(with_first), along.nodes[0]);
            let by_next = apply(across, along.nodes[k + 2]);
            let rest = subtract(subtract(along.nodes[k + 1], by_first), by_next);
            along.nodes[k + 1] = apply(inverse, rest);
        }
        let size = along.size;
        for k in 0..count {
            let own = &mut along.inner[k * size..(k + 1) * size];
            self.elements[self.pieces[k]].unknowns([along.nodes[k], along.nodes[k + 1]], own);
        }
    }
}

impl Chain {
    /// The phase of the determinant of what was eliminated.
    pub(crate) fn phase(&self, components: usize) -> Complex {
        let elements =
            self.pieces.iter().fold(Complex::new(1.0, 0.0), |phase, &piece| phase * self.elements[piece].phase());
        self.inner.iter().fold(elements, |phase, node| {
            let [[a, b], [c, d]] = node.inverse;
            turned(phase, if components == 1 { a } else { a * d - b * c }.conj())
        })
    }

    /// Loads on the two ends that do as loads on everything; what remains within is reduced in place, for
    /// [`Self::motion`].
    pub(crate) fn reduce(&self, loads: &mut Along) -> [Node; 2] {
        for (k, (&piece, own)) in self.pieces.iter().zip(loads.inner.chunks_exact_mut(loads.size)).enumerate() {
            let on = self.elements[piece].reduce(own);
            for (node, on) in on.iter().enumerate() {
                loads.nodes[k + node] = add(loads.nodes[k + node], *on);
            }
        }
        for (k, eliminated) in self.inner.iter().enumerate() {
            let moved = apply(&eliminated.inverse, loads.nodes[k + 1]);
            let [[_, across], _] = &self.elements[self.pieces[k + 1]].blocks;
            loads.nodes[0] = subtract(loads.nodes[0], apply(&eliminated.with_first, moved));
            loads.nodes[k + 2] = subtract(loads.nodes[k + 2], apply(&transposed(across), moved));
        }
        [loads.nodes[0], loads.nodes[self.pieces.len()]]
    }
}

/// A series with one more element, whose first node is eliminated.
#[inline(always)]
pub(crate) fn joined<T: Number>(
    [[start, with_first], [_, last]]: Ends<T>,
    [[first, across], [_, second]]: &Ends<T>,
    components: usize,
) -> (Ends<T>, Eliminated<T>) {
    let inverse = inverse(&plus(&last, first), components);
    let through = times(&with_first, &inverse);
    let onward = times(&inverse, across);
    let start = minus(&start, &times(&through, &transposed(&with_first)));
    let with_end = negative(&times(&with_first, &onward));
    let end = minus(second, &times(&transposed(across), &onward));
    ([[start, with_end], [transposed(&with_end), end]], Eliminated { inverse, with_first })
}

#[inline(always)]
fn map<T: Number>(f: impl Fn(usize, usize) -> T) -> Block<T> {
    [[f(0, 0), f(0, 1)], [f(1, 0), f(1, 1)]]
}

#[inline(always)]
fn plus<T: Number>(a: &Block<T>, b: &Block<T>) -> Block<T> {
    map(
        #[inline(always)]
        |i, j| a[i][j] + b[i][j],
    )
}

#[inline(always)]
fn minus<T: Number>(a: &Block<T>, b: &Block<T>) -> Block<T> {
    map(
        #[inline(always)]
        |i, j| a[i][j] - b[i][j],
    )
}

#[inline(always)]
fn negative<T: Number>(a: &Block<T>) -> Block<T> {
    map(
        #[inline(always)]
        |i, j| -a[i][j],
    )
}

#[inline(always)]
fn transposed<T: Number>(a: &Block<T>) -> Block<T> {
    map(
        #[inline(always)]
        |i, j| a[j][i],
    )
}

#[inline(always)]
fn times<T: Number>(a: &Block<T>, b: &Block<T>) -> Block<T> {
    map(
        #[inline(always)]
        |i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j],
    )
}

#[inline(always)]
fn apply<T: Number>(a: &Block<T>, x: Node<T>) -> Node<T> {
    [a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]]
}

#[inline(always)]
fn add(a: Node, b: Node) -> Node {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
fn subtract<T: Number>(a: Node<T>, b: Node<T>) -> Node<T> {
    [a[0] - b[0], a[1] - b[1]]
}

/// Of one or two components.
#[inline(always)]
fn inverse<T: Number>(a: &Block<T>, components: usize) -> Block<T> {
    if components == 1 {
        return [[a[0][0].inverse(), T::zero()], [T::zero(); 2]];
    }
    let scale = (a[0][0] * a[1][1] - a[0][1] * a[1][0]).inverse();
    [[a[1][1] * scale, -(a[0][1] * scale)], [-(a[1][0] * scale), a[0][0] * scale]]
}
