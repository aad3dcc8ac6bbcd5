//! The equations of one beam linearised at rest, with the motion of its root and the loads on its stations held.
//!
//! # Beams as substructures
//!
//! What reaches a beam from the rest of a mechanism is the motion of its root (angular velocity and acceleration, and the
//! acceleration of its origin) and the loads on its stations. With symbols in their place, the equations of a beam are
//! differentiated by its own rows alone, so the work for a beam does not depend on the mechanism around it. Everything
//! between two beams, or a beam and a joint, follows from walks over the bodies
//! (`mechanics/inertia/variation.rs`), in which each coordinate of a beam moves its stations as a joint moves its body.

use crate::algebra::{ExprId, Graph, Matrix3, Stage, SymbolId, Vector3, substitute};
use crate::base::ids::{BeamId, BodyId};
use crate::mechanics::motion::{BeamMotion, FrameMotion, Kinematics, StationMotion, StepAxis, Wrench, headings};
use crate::mechanics::setup::{Context, Mirrored, SymbolList, added, by_symbol, mirrored};

use super::flexible::{BeamInertia, FromStations};

/// What a beam's equations ask of the motion of its root, and the loads on its root, by one of its unknowns.
pub(super) struct OwnColumn {
    pub(super) unknown: usize,
    /// Derivatives of the equation by angular velocity, angular acceleration and acceleration of the root.
    pub(super) by_motion: [Vector3; 3],
    /// Derivatives of the load on the root by position and by velocity, the loads on the stations held.
    pub(super) loads: [Wrench; 2],
}

/// How each of the rows of a beam's sections moves it, along the axes of its root.
pub(super) struct Mobility {
    pub(super) unknowns: Vec<usize>,
    rows: Vec<RowMotion>,
}

/// How one row moves the beam.
struct RowMotion {
    row: usize,
    /// The changes of arms.
    arms: Vec<(usize, Vector3)>,
    /// The section that it turns, with the turn along the axes of the section.
    turn: Option<(usize, Vector3)>,
}

impl Mobility {
    pub(super) fn new(g: &mut Graph, context: &Context, kinematics: &Kinematics, id: BeamId) -> Self {
        let (sections, motion) = (context.sections, &kinematics.beams[id.index()]);
        let of_beam = sections.of(id);
        let units = Matrix3::identity(g).0;
        let mut turns = Vec::new();
        for (k, (section, rows)) in motion.sections.iter().zip(&of_beam.rotations).enumerate() {
            for (row, unit) in rows.iter().zip(units) {
                if let Some(row) = *row {
                    turns.push((row, (k, section.turning(g, unit))));
                }
            }
        }
        let arms: Vec<ExprId> = motion.arms().flat_map(|(_, arm)| arm.vector.0).collect();
        let moving = of_beam.rows().into_iter().map(|row| {
            let changes = by_symbol(g, &arms, sections.position.ids[row]);
            let arms = changes.chunks(3).map(vector).enumerate();
            let arms = arms.filter(|(_, change)| !change.is_zero(g)).collect();
            let turn = turns.iter().find(|(turning, _)| *turning == row).map(|(_, turn)| *turn);
            RowMotion { row, arms, turn }
        });
        Self { rows: moving.collect(), unknowns: sections.unknowns(id) }
    }
}

impl RowMotion {
    /// Mass between two rows of a beam whose stations carry nothing.
    fn mass(&self, g: &mut Graph, inertia: &BeamInertia, other: &Self) -> ExprId {
        let mut terms = Vec::new();
        for (k, moved) in &self.arms {
            for (j, along) in &other.arms {
                let product = moved.dot(g, *along);
                terms.push(g.mul(inertia.second[*k][*j], product));
            }
        }
        if let (Some((k, turned)), Some((same, along))) = (self.turn, other.turn)
            && k == same
        {
            let momentum = inertia.turning[k].apply(g, turned);
            terms.push(momentum.dot(g, along));
        }
        g.sum(terms)
    }
}

/// Sums over the unknowns of what belongs to some rows.
fn summed(g: &mut Graph, context: &Context, by_row: impl Iterator<Item = (usize, ExprId)>) -> Vec<ExprId> {
    let first = context.symbols.q.ids.len();
    let mut all = vec![g.zero(); first + context.sections.rows.len()];
    by_row.for_each(|(row, value)| all[first + row] = value);
    context.sections.forces(g, &all)
}

/// The sums over the unknowns of a beam of vectors that belong to some rows.
fn by_unknowns(g: &mut Graph, context: &Context, unknowns: &[usize], by_row: &[(usize, Vector3)]) -> Vec<Vector3> {
    let components = [0, 1, 2].map(|component| {
        let by_row = by_row.iter().map(|(row, vector)| (*row, vector.0[component]));
        summed(g, context, by_row)
    });
    unknowns.iter().map(|&unknown| Vector3(components.each_ref().map(|component| component[unknown]))).collect()
}

/// Symbols for what reaches a beam from the rest of the mechanism, used for one beam after the other.
pub(super) struct Interface {
    motion: SymbolList,
    loads: SymbolList,
}

/// What couples the rows of the same beam, as columns: mass up to the diagonal, damping and stiffness, the last two of the
/// stations apart, without which they are symmetric or opposite across the diagonal.
pub(super) struct OwnBlocks {
    mass: Vec<Vec<ExprId>>,
    sections: [Vec<Vec<ExprId>>; 2],
    stations: [Vec<Vec<ExprId>>; 2],
}

impl Interface {
    pub(super) fn new(g: &mut Graph, context: &Context) -> Self {
        let beams = context.mechanism.beams.iter();
        let stations = beams.map(|beam| beam.stations.len()).max().unwrap_or(0);
        let mut list = |name: &str, count: usize| {
            let symbols = (0..count).map(|k| g.symbol(format!("{name}_{k}"), Stage::Rate));
            let (ids, values) = symbols.unzip();
            SymbolList { ids, values }
        };
        Self { motion: list("root_motion", 9), loads: list("station_load", 6 * stations) }
    }

    fn motion(&self) -> [Vector3; 3] {
        [0, 3, 6].map(|first| vector(&self.motion.values[first..]))
    }

    fn load(&self, station: usize) -> [Vector3; 2] {
        [0, 3].map(|first| vector(&self.loads.values[6 * station + first..]))
    }
}

fn vector(components: &[ExprId]) -> Vector3 {
    Vector3([components[0], components[1], components[2]])
}

impl OwnBlocks {
    pub(super) fn new(g: &mut Graph, context: &Context) -> Self {
        let size = context.symbols.q.ids.len() + context.sections.rows.len();
        let empty = vec![vec![g.zero(); size]; size];
        let blocks = || [empty.clone(), empty.clone()];
        Self { mass: empty.clone(), sections: blocks(), stations: blocks() }
    }

    /// Mass, damping and stiffness by the unknowns.
    pub(super) fn by_unknowns(self, g: &mut Graph, context: &Context) -> [Vec<Vec<ExprId>>; 3] {
        let mass = context.sections.matrix(g, &self.mass, Mirrored::Equal);
        let mut by_unknowns = |columns: Vec<Vec<ExprId>>| {
            let mirrored = mirrored(g, context, &columns);
            context.sections.matrix(g, &columns, mirrored)
        };
        let ([a, b], [c, d]) = (self.sections.map(&mut by_unknowns), self.stations.map(&mut by_unknowns));
        [mass, added(g, &a, &c), added(g, &b, &d)]
    }

    /// Linearises a beam whose sections strain with the forces `strained` along their rows. `wrenches` are those of the
    /// bodies with everything they carry, in their own axes.
    pub(super) fn linearise(
        &mut self,
        g: &mut Graph,
        context: &Context,
        (id, interface, mobility): (BeamId, &Interface, &Mobility),
        kinematics: &Kinematics,
        (wrenches, strained): (&[Wrench], &[ExprId]),
    ) -> Vec<OwnColumn> {
        let sections = context.sections;
        let rows = sections.of(id).rows();
        let (forces, on_root) = interface.equations(g, context, id, (&rows, strained));
        let actual = interface.actual(g, context, id, kinematics, wrenches);
        let zeros = vec![g.zero(); sections.rows.len()];
        let mut at_rest: Vec<_> = sections.velocity.with(&zeros).chain(sections.acceleration.with(&zeros)).collect();
        let still = substitute(g, &forces, &at_rest);
        let still = summed(g, context, rows.iter().copied().zip(still));
        let unknowns = &mobility.unknowns;
        let equations: Vec<ExprId> = unknowns.iter().map(|&unknown| still[unknown]).collect();
        let asked = interface.asked(g, &equations, &actual);

        let outputs = [&forces[..], &on_root].concat();
        at_rest.extend(&actual);
        let columns = [&sections.velocity, &sections.position].map(|list| {
            let mut all = Vec::new();
            for &row in &rows {
                all.extend(by_symbol(g, &outputs, list.ids[row]));
            }
            substitute(g, &all, &at_rest).chunks(outputs.len()).map(<[_]>::to_vec).collect::<Vec<_>>()
        });
        self.set(g, context, (id, mobility), &columns);
        let loads = [1, 0].map(|kind| {
            (forces.len()..outputs.len())
                .map(|output| {
                    let by_row = columns[kind].iter().map(|column| column[output]);
                    summed(g, context, rows.iter().copied().zip(by_row))
                })
                .collect::<Vec<_>>()
        });
        unknowns
            .iter()
            .zip(asked)
            .map(|(&unknown, by_motion)| OwnColumn {
                unknown,
                by_motion,
                loads: loads.each_ref().map(|outputs| {
                    let load = |first: usize| Vector3([0, 1, 2].map(|c| outputs[first + c][unknown]));
                    Wrench { force: load(0), moment: load(3) }
                }),
            })
            .collect()
    }

    /// Sets the entries of a beam: mass, and from the columns of its rows damping and stiffness.
    fn set(
        &mut self,
        g: &mut Graph,
        context: &Context,
        (id, mobility): (BeamId, &Mobility),
        columns: &[Vec<Vec<ExprId>>; 2],
    ) {
        let first = context.symbols.q.ids.len();
        let inertia = BeamInertia::new(g, context, id);
        for moved in &mobility.rows {
            for along in mobility.rows.iter().filter(|along| along.row <= moved.row) {
                self.mass[first + moved.row][first + along.row] = moved.mass(g, &inertia, along);
            }
        }
        let of_beam = context.sections.of(id);
        let rows = of_beam.rows();
        let stations: Vec<usize> = of_beam.stations.iter().flatten().flatten().copied().collect();
        for (kind, columns) in columns.iter().enumerate() {
            for (&j, column) in rows.iter().zip(columns) {
                let blocks = if stations.contains(&j) { &mut self.stations } else { &mut self.sections };
                for (&i, &entry) in rows.iter().zip(column) {
                    blocks[kind][first + j][first + i] = entry;
                }
            }
        }
    }
}

impl Interface {
    /// The forces along the rows of a beam, and force and moment on its root without those of the stations.
    fn equations(
        &self,
        g: &mut Graph,
        context: &Context,
        id: BeamId,
        (rows, strained): (&[usize], &[ExprId]),
    ) -> (Vec<ExprId>, [ExprId; 6]) {
        let sections = context.sections;
        let root = FrameMotion::moving(g, self.motion());
        let bending = (sections.by_themselves(g, id), headings(g, context, id, true));
        let motion = BeamMotion::new(g, context.mechanism, context.values, id, &root, &bending);
        let mut from = FromStations::nothing(g, context).swap_remove(id.index());
        for station in 0..motion.stations.len() {
            from.add(g, &motion, station, self.load(station));
        }
        let load = BeamInertia::new(g, context, id).load(g, &motion, &root, &from);
        let mut along = strained.to_vec();
        load.add_along(g, sections, id, &motion, &mut along);
        let ([a, b, c], [d, e, f]) = (load.force.0, load.moment.0);
        (rows.iter().map(|&row| along[row]).collect(), [a, b, c, d, e, f])
    }

    /// What equations ask of the motion of the root: derivatives by its three vectors.
    fn asked(&self, g: &mut Graph, equations: &[ExprId], actual: &[(SymbolId, ExprId)]) -> Vec<[Vector3; 3]> {
        let mut all = Vec::new();
        for &symbol in &self.motion.ids {
            all.extend(by_symbol(g, equations, symbol));
        }
        let all = substitute(g, &all, actual);
        let count = equations.len();
        let of = |k: usize| [0, 3, 6].map(|first| Vector3([0, 1, 2].map(|c| all[(first + c) * count + k])));
        (0..count).map(of).collect()
    }

    /// What reaches a beam, for substitution.
    fn actual(
        &self,
        g: &mut Graph,
        context: &Context,
        id: BeamId,
        kinematics: &Kinematics,
        wrenches: &[Wrench],
    ) -> Vec<(SymbolId, ExprId)> {
        let frame = &kinematics.of(context.mechanism.beams[id.index()].body).frame;
        let motion = [frame.angular_velocity, frame.angular_acceleration, frame.acceleration];
        let motion: Vec<ExprId> = motion.iter().flat_map(|vector| vector.0).collect();
        let mut actual: Vec<_> = self.motion.with(&motion).collect();
        for branch in &context.topology.branches {
            let body = kinematics.of(branch.body);
            let Some((beam, station)) = body.flexure else { continue };
            if beam != id {
                continue;
            }
            let Wrench { force, moment } = wrenches[branch.body.index()];
            let mut write = |vector: Vector3| match body.to_parent {
                Some(rotation) => rotation.apply(g, vector),
                None => vector,
            };
            let load: Vec<ExprId> = [write(force), write(moment)].iter().flat_map(|vector| vector.0).collect();
            let symbols = &self.loads.ids[6 * station..6 * (station + 1)];
            actual.extend(symbols.iter().copied().zip(load));
        }
        actual
    }
}

/// How the unknowns of a beam move the body of a station, in its own axes: each turns and moves it, all at once.
pub(super) fn station_steps(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    mobility: &Mobility,
    (body, id, station): (BodyId, BeamId, usize),
) -> Vec<(usize, StepAxis)> {
    let motion = kinematics.of(body);
    let beam = &context.mechanism.beams[id.index()];
    let own_axes = Matrix3([0, 1, 2].map(|k| context.values.vector(g, &beam.axes[k])));
    let StationMotion { section, reach, .. } = &kinematics.beams[id.index()].stations[station];
    let units = Matrix3::identity(g).0;
    let mut turns = Vec::new();
    for (row, unit) in context.sections.of(id).stations[station].iter().zip(units) {
        if let Some(row) = *row {
            let turning = section.turning(g, unit);
            turns.push((row, own_axes.apply(g, turning)));
        }
    }
    let turns = by_unknowns(g, context, &mobility.unknowns, &turns);
    let zero = Vector3::zero(g);
    let to_own = motion.to_parent.map(Matrix3::transpose);
    let slides = mobility.rows.iter().map(|RowMotion { row, arms, .. }| {
        let directions = arms.iter().filter(|(k, _)| *k < reach.len());
        let slide = directions.fold(zero, |sum, (k, change)| {
            let moved = change.scale(g, reach[*k]);
            sum.add(g, moved)
        });
        (*row, slide)
    });
    let slides: Vec<(usize, Vector3)> = slides.collect();
    let slides = by_unknowns(g, context, &mobility.unknowns, &slides);
    let steps = mobility.unknowns.iter().zip(turns).zip(slides).map(|((&unknown, turn), slide)| {
        let slide = to_own.map_or(slide, |to_own| to_own.apply(g, slide));
        let coordinate = context.topology.free[unknown];
        (unknown, StepAxis { coordinate, turn: Some(turn), slide: Some(slide), own_axis: turn, point: zero })
    });
    steps.collect()
}
