//! How the motion of each body is written in the equations of inertia and weight.
//!
//! Two choices make this part of the equations short:
//!
//! - Bodies that turn about the same axis, one after the other, form a run. The natural coordinates of a run are the
//!   absolute angles of its bodies, that is, the sums of the joint angles: turning one body then moves the bodies
//!   behind it without turning them. The equations are derived in these angles and summed back at the end ([`Runs`]).
//! - All vectors of a run, or of a body that coasts on a planar joint, are written in the axes of the body before it.
//!   Any other body is written in its own axes, in which its mass distribution is constant.
//!
//! # Absolute angles
//!
//! The natural coordinates of a run are the absolute angles of its bodies, the sums of the joint angles: turning one
//! body moves the bodies behind it without turning them. Inertia and weight are derived, linearised and differentiated
//! in these angles; forces, matrices and their derivatives are summed back at the end, with one or two additions per
//! entry (`Runs`). Forces and constraints stay in the declared coordinates, because cancelling contributions of a stiff
//! spring would leave rounding errors.

use crate::algebra::{ExprId, Graph, SymbolId, Vector3};
use crate::base::ids::BodyId;
use crate::census::taken;
use crate::model::mechanism::{Frame, Joint, Mechanism, Motion, StepMotion};
use crate::topology::{Branch, Topology};

use super::coordinate::CoordinateMotion;
use super::sections::Sections;
use super::symbols::{SymbolList, Symbols};
use super::values::Values;

/// How the motion of a body is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BodyLayout {
    /// Whether it turns about the axis of its parent's joint, with its angle measured from the same direction.
    pub(crate) continues_run: bool,
    /// Whether its vectors are written in its own axes instead of its parent's.
    pub(crate) own_axes: bool,
}

/// The layout of each body, by body id.
#[derive(Clone, Debug)]
pub(crate) struct Layout(Vec<BodyLayout>);

impl Layout {
    /// Everything in the common frame, with no runs.
    pub(crate) fn common(bodies: usize) -> Self {
        Self(vec![BodyLayout::default(); bodies])
    }

    pub(crate) fn of(&self, body: BodyId) -> BodyLayout {
        self.0[body.index()]
    }
}

/// Coordinates in which inertia and weight are derived: the absolute angles of the bodies along runs, otherwise the
/// unknowns themselves.
pub(crate) struct Runs {
    pub(crate) layout: Layout,
    /// By free coordinate: the preceding coordinate in its run.
    before: Vec<Option<usize>>,
    /// By unknown: the absolute angle along a run, otherwise the unknown itself; the rates below correspond.
    pub(crate) position: SymbolList,
    pub(crate) velocity: SymbolList,
    pub(crate) acceleration: SymbolList,
}

impl Runs {
    pub(crate) fn new(
        g: &mut Graph,
        mechanism: &Mechanism,
        topology: &Topology,
        values: &Values,
        symbols: &Symbols,
    ) -> Self {
        let turns: Vec<Option<Turn>> = {
            let mut by_body = vec![None; mechanism.bodies.len()];
            for branch in &topology.branches {
                by_body[branch.body.index()] = Turn::of(g, mechanism, values, branch);
            }
            by_body
        };
        let unknown = |turn: &Turn| {
            let id = turn.joint.steps[0].coordinate;
            topology.free.iter().position(|&free| free == id)
        };
        let mut before = vec![None; topology.free.len()];
        let mut layout = vec![BodyLayout::default(); mechanism.bodies.len()];
        let mut in_run = vec![false; mechanism.bodies.len()];
        for branch in &topology.branches {
            let body = branch.body.index();
            let (Some(turn), Frame::Body(parent)) = (&turns[body], branch.parent) else {
                continue;
            };
            let Some(first) = &turns[parent.index()] else {
                continue;
            };
            let obstacles = [
                (turn.axis != first.axis, "another axis"),
                (turn.inboard_turned, "turned before the joint"),
                (first.outboard_turned, "turned after the joint before"),
                (turn.outboard_moved, "moved after the joint"),
            ];
            if let Some((_, obstacle)) = obstacles.iter().find(|(stands, _)| *stands) {
                taken(|| format!("layout: no run, {obstacle}"));
                continue;
            }
            if let (Some(k), Some(previous)) = (unknown(turn), unknown(first)) {
                before[k] = Some(previous);
                taken(|| "layout: a body continues a run".into());
                layout[body].continues_run = true;
                in_run[body] = true;
                in_run[parent.index()] = true;
            }
        }
        for branch in &topology.branches {
            let joint = &mechanism.joints[branch.joint.index()];
            let body = branch.body.index();
            // A station that carries nothing is best written in the axes of its beam.
            let bare = joint.flexure.is_some() && !topology.carries(branch.body);
            layout[body].own_axes = !in_run[body] && !mechanism.glides(joint) && !bare;
        }
        let mut this = Self {
            layout: Layout(layout),
            before,
            position: symbols.q.clone(),
            velocity: symbols.velocity.clone(),
            acceleration: symbols.acceleration.clone(),
        };
        for k in 0..this.before.len() {
            if this.before[k].is_some() {
                for list in [&mut this.position, &mut this.velocity, &mut this.acceleration] {
                    let symbol = g.symbol_info(list.ids[k]).clone();
                    (list.ids[k], list.values[k]) = g.symbol(format!("{}_in_all", symbol.name), symbol.stage);
                }
            }
        }
        this
    }

    /// Adds the reactions of constraints to the unknowns.
    pub(crate) fn with_reactions(mut self, symbols: &Symbols) -> Self {
        let lists = [
            (&mut self.position, &symbols.q),
            (&mut self.velocity, &symbols.velocity),
            (&mut self.acceleration, &symbols.acceleration),
        ];
        for (list, all) in lists {
            let known = list.ids.len();
            list.ids.extend(&all.ids[known..]);
            list.values.extend(&all.values[known..]);
        }
        self
    }

    /// Adds the sections of beams to the unknowns.
    pub(crate) fn with_sections(mut self, sections: &Sections) -> Self {
        let lists = [
            (&mut self.position, &sections.position),
            (&mut self.velocity, &sections.velocity),
            (&mut self.acceleration, &sections.acceleration),
        ];
        for (list, unknowns) in lists {
            list.ids.extend(&unknowns.ids);
            list.values.extend(&unknowns.values);
        }
        self
    }

    /// Whether there are runs.
    pub(crate) fn exist(&self) -> bool {
        self.continuing() > 0
    }

    /// Whether half of the free coordinates or more continue a run.
    pub(crate) fn prevail(&self) -> bool {
        self.exist() && 2 * self.continuing() >= self.before.len()
    }

    fn continuing(&self) -> usize {
        self.before.iter().flatten().count()
    }

    /// No runs: every body in its own axes, and the unknowns themselves.
    pub(crate) fn apart(&self, symbols: &Symbols) -> Self {
        let own_axes = BodyLayout { continues_run: false, own_axes: true };
        Self {
            layout: Layout(vec![own_axes; self.layout.0.len()]),
            before: vec![None; self.before.len()],
            position: symbols.q.clone(),
            velocity: symbols.velocity.clone(),
            acceleration: symbols.acceleration.clone(),
        }
    }

    /// The motion along an unknown.
    pub(crate) fn motion(&self, k: usize) -> CoordinateMotion {
        CoordinateMotion {
            position: self.position.values[k],
            velocity: self.velocity.values[k],
            acceleration: self.acceleration.values[k],
        }
    }

    /// The sum of joint angles for each absolute angle, and the same for the rates: for substitution.
    pub(crate) fn sums(&self, g: &mut Graph, symbols: &Symbols) -> Vec<(SymbolId, ExprId)> {
        let mut sums = Vec::new();
        let lists = [
            (&self.position, &symbols.q),
            (&self.velocity, &symbols.velocity),
            (&self.acceleration, &symbols.acceleration),
        ];
        for (list, unknowns) in lists {
            for k in 0..self.before.len() {
                if self.before[k].is_none() {
                    continue;
                }
                let way: Vec<usize> = std::iter::successors(Some(k), |&k| self.before[k]).collect();
                let sum = g.sum(way.iter().rev().map(|&k| unknowns.values[k]));
                sums.push((list.ids[k], sum));
            }
        }
        sums
    }

    /// Unknowns that follow `k` in its run.
    fn after(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.before.len()).filter(move |&next| self.before[next] == Some(k))
    }

    /// Forces along the unknowns from forces along the absolute angles: each is the sum over this body and those behind
    /// it.
    pub(crate) fn forces(&self, g: &mut Graph, along: &[ExprId]) -> Vec<ExprId> {
        let mut summed = vec![None; along.len()];
        (0..along.len()).map(|k| self.summed(g, &mut summed, &|k| along[k], k)).collect()
    }

    fn summed(&self, g: &mut Graph, summed: &mut [Option<ExprId>], of: &impl Fn(usize) -> ExprId, k: usize) -> ExprId {
        if let Some(sum) = summed[k] {
            return sum;
        }
        let mut sum = of(k);
        for next in self.after(k) {
            let behind = self.summed(g, summed, of, next);
            sum = g.add(sum, behind);
        }
        summed[k] = Some(sum);
        sum
    }

    /// Transforms a matrix from the absolute angles to the unknowns, both stored by columns: each entry is the sum of
    /// all entries from its row and its column onwards. If the matrix is `symmetric`, only entries whose column is not
    /// nearer to the ground than the row, according to `outward`, are used.
    pub(crate) fn matrix(
        &self,
        g: &mut Graph,
        columns: &[Vec<ExprId>],
        symmetric: bool,
        outward: &[usize],
    ) -> Vec<Vec<ExprId>> {
        let n = columns.len();
        let ordered = |i: usize, j: usize| if symmetric && outward[i] > outward[j] { (j, i) } else { (i, j) };
        let entry = |i: usize, j: usize| {
            let (row, column) = ordered(i, j);
            columns[column][row]
        };
        // sum over the columns that follow
        let mut rows: Vec<Vec<ExprId>> = Vec::with_capacity(n);
        for i in 0..n {
            let mut summed = vec![None; n];
            rows.push((0..n).map(|j| self.summed(g, &mut summed, &|j| entry(i, j), j)).collect());
        }
        let mut known = vec![vec![None; n]; n];
        (0..n).map(|j| (0..n).map(|i| self.entry(g, &mut known, &rows, &ordered, (i, j))).collect()).collect()
    }

    /// Sums an entry over the rows that follow as well.
    fn entry(
        &self,
        g: &mut Graph,
        known: &mut [Vec<Option<ExprId>>],
        rows: &[Vec<ExprId>],
        ordered: &impl Fn(usize, usize) -> (usize, usize),
        (i, j): (usize, usize),
    ) -> ExprId {
        let (i, j) = ordered(i, j);
        if let Some(entry) = known[i][j] {
            return entry;
        }
        let mut sum = rows[i][j];
        for next in self.after(i) {
            let behind = self.entry(g, known, rows, ordered, (next, j));
            sum = g.add(sum, behind);
        }
        known[i][j] = Some(sum);
        sum
    }
}

/// A joint that can be part of a run: a single turn about a free coordinate.
#[derive(Clone)]
struct Turn<'a> {
    joint: &'a Joint,
    axis: Vector3,
    inboard_turned: bool,
    outboard_turned: bool,
    outboard_moved: bool,
}

impl<'a> Turn<'a> {
    fn of(g: &mut Graph, mechanism: &'a Mechanism, values: &Values, branch: &Branch) -> Option<Self> {
        let joint = &mechanism.joints[branch.joint.index()];
        let [step] = &joint.steps[..] else {
            return None;
        };
        let motion = &mechanism.coordinates[step.coordinate.index()].motion;
        if branch.reversed || step.motion != StepMotion::Turn || *motion != Motion::Free {
            return None;
        }
        let offset = values.vector(g, &joint.to_placement.offset);
        Some(Self {
            joint,
            axis: values.vector(g, &step.axis),
            outboard_moved: !offset.is_zero(g),
            inboard_turned: !joint.from_placement.rotations.is_empty(),
            outboard_turned: !joint.to_placement.rotations.is_empty(),
        })
    }
}
