//! Random trees of bodies.

use super::joints::{self, Draft};
use super::values::{Frames, Source};
use super::{Plan, Random, Setting};
use crate::model::{Body, Frame, Input, Joint, Model, Motion, Part, Placement, Step, Unit, Value, Values, Word};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// The most free coordinates: the cost of the oracle grows with their square.
const MOST: usize = 8;

pub(super) struct Builder {
    pub(super) source: Source,
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    pub(super) inputs: Vec<Input>,
    /// For each body, the number of drives that carry it, counted so that bodies with equal numbers are steady relative
    /// to each other. The ground has 0.
    pub(super) carriers: Vec<usize>,
    /// The body that spins about its axis of symmetry, and the axis.
    pub(super) rotor: Option<(usize, [f64; 3])>,
    /// A body is driven along a non-vertical line as well as about the vertical: the direction of flow of a resisting
    /// medium past it would keep changing.
    pub(super) drifting: bool,
    /// Bodies that still need a coordinate.
    waiting: usize,
}

impl Builder {
    pub(super) fn new(random: Random, special: bool) -> Self {
        Self {
            source: Source::new(random, special),
            bodies: Vec::new(),
            joints: Vec::new(),
            inputs: Vec::new(),
            carriers: Vec::new(),
            rotor: None,
            drifting: false,
            waiting: 0,
        }
    }

    pub(super) fn build(mut self, plan: &Plan) -> Model {
        self.waiting = plan.bodies;
        let gravity = self.gravity(plan.setting);
        self.driven_bodies(plan.setting);
        let trunk = self.bodies.len();
        for _ in 0..plan.bodies {
            self.free_body(plan.setting, trunk);
        }
        if plan.rotor {
            self.spinning_body();
        }
        self.give_leaves_mass();
        self.source.random.shuffle(&mut self.joints);
        joints::name(&mut self.joints);
        let (points, forces) = self.forces(plan.setting);
        Model {
            name: "Tree".to_owned(),
            inputs: self.inputs,
            design: self.source.design,
            gravity,
            bodies: self.bodies,
            beams: Vec::new(),
            joints: self.joints,
            points,
            forces,
        }
    }

    fn gravity(&mut self, setting: Setting) -> Values {
        let components = match setting {
            Setting::Spinning | Setting::Climbing => [0.0, 0.0, -9.81],
            Setting::Still | Setting::Conveyed => self.source.random.vector(9.81),
        };
        components.map(|component| self.source.value(component, Unit::MetrePerSquareSecond))
    }

    /// Adds the bodies that are moved by drives.
    fn driven_bodies(&mut self, setting: Setting) {
        match setting {
            Setting::Still => {}
            Setting::Spinning => self.shaft(Frame::Ground),
            Setting::Conveyed => {
                let axis = self.source.axis();
                let placements = [self.source.placement(), self.source.placement()];
                let room = self.room();
                let draft = self.sliding_joint(axis, room);
                self.driven_body(draft, Frame::Ground, placements);
            }
            Setting::Climbing => {
                let placements = [self.upright(), self.upright()];
                let mut lift = joints::slide(Z);
                self.drive(&mut lift);
                self.driven_body((Word::Prismatic, vec![lift]), Frame::Ground, placements);
                self.shaft(Frame::Body(0));
            }
        }
    }

    /// Adds a body driven about the vertical.
    fn shaft(&mut self, parent: Frame) {
        let axis = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 2.5]][self.source.random.below(3)];
        let placements = [self.upright(), self.source.placement()];
        let room = self.room();
        let draft = self.turning_joint(axis, room);
        self.driven_body(draft, parent, placements);
    }

    /// A placement that keeps z vertical.
    fn upright(&mut self) -> Placement {
        let offset = self.source.position(0.5);
        let angle = self.source.between(-2.0, 2.0, Unit::Radian);
        let turned = self.source.random.chance(0.5);
        Placement { offset, rotations: if turned { vec![(Z, angle)] } else { Vec::new() } }
    }

    /// How many free coordinates are still available, with one reserved for every body to come.
    fn room(&self) -> usize {
        let steps = self.joints.iter().flat_map(|joint| &joint.steps);
        let free = steps.filter(|step| step.drive.is_none()).count();
        MOST.saturating_sub(free + self.waiting)
    }

    /// Drives a step by a new input or by one that other drives use as well.
    pub(super) fn drive(&mut self, step: &mut Step) {
        let unit = step.motion.rate_unit();
        let shared = self.inputs.iter().position(|input| input.unit == unit);
        let input = match shared {
            Some(input) if self.source.random.chance(0.5) => input,
            _ => {
                let name = format!("u{}", self.inputs.len());
                self.inputs.push(Input { name, unit });
                self.inputs.len() - 1
            }
        };
        let factor = if self.source.random.chance(0.5) { 1.0 } else { -0.7 };
        *step = step.clone().driven(input, factor);
    }

    /// Adds a driven body; occasionally massless, unless it has free coordinates of its own.
    fn driven_body(&mut self, draft: Draft, parent: Frame, placements: [Placement; 2]) {
        let free = draft.1.iter().any(|step| step.drive.is_none());
        let parts = if !free && self.source.random.chance(0.6) { Vec::new() } else { self.source.parts() };
        self.add(parts, draft, parent, placements);
    }

    fn free_body(&mut self, setting: Setting, trunk: usize) {
        let aligned = self.source.frames == Frames::Aligned;
        let random = &mut self.source.random;
        let beside = setting == Setting::Still || random.chance(0.15);
        let rooted = if aligned { 0.1 } else { 0.4 };
        let parent = if self.bodies.is_empty() || (beside && random.chance(rooted)) {
            Frame::Ground
        } else if random.chance(0.5) {
            // A long chain.
            Frame::Body(self.bodies.len() - 1)
        } else {
            Frame::Body(trunk.saturating_sub(1) + random.below(self.bodies.len() - trunk.saturating_sub(1)))
        };
        self.waiting -= 1;
        let room = self.room().max(1);
        let draft = self.source.joint(room);
        let placements = [self.source.placement(), self.source.outer_placement()];
        // Leaves get their mass at the end.
        let parts = if draft.1.len() < 2 && self.source.random.chance(0.2) { Vec::new() } else { self.source.parts() };
        self.add(parts, draft, parent, placements);
    }

    /// Adds a body that spins about its own axis of symmetry, on any body.
    fn spinning_body(&mut self) {
        let axis = self.source.axis();
        let parent = Frame::Body(self.bodies.len() - 1);
        // The joint may sit at another place on the axis of symmetry.
        let along = self.source.random.between(-0.4, 0.4);
        let on_axis = Placement::at(axis.map(|component| Value::Number(along * component)));
        let placements = [self.source.placement(), on_axis];
        let room = self.room();
        let draft = self.spinning_joint(axis, room);
        let parts = self.source.rotor(axis);
        self.rotor = Some((self.bodies.len(), axis));
        self.add(parts, draft, parent, placements);
    }

    fn give_leaves_mass(&mut self) {
        for index in 0..self.bodies.len() {
            let frame = Frame::Body(index);
            let degree = self.joints.iter().filter(|j| j.from == frame || j.to == frame).count();
            if degree < 2 && self.bodies[index].parts.is_empty() {
                self.bodies[index].parts = self.source.parts();
            }
        }
    }

    /// Adds a body and its joint, declared in either direction.
    fn add(&mut self, parts: Vec<Part>, (word, mut steps): Draft, parent: Frame, [inboard, outboard]: [Placement; 2]) {
        let index = self.bodies.len();
        let name = format!("body{index}");
        self.bodies.push(Body { name, parts });
        let carrier = match parent {
            Frame::Ground => 0,
            Frame::Body(parent) => self.carriers[parent],
        };
        let driven = steps.iter().any(|step| step.drive.is_some());
        let next = 1 + self.carriers.iter().copied().max().unwrap_or(0);
        self.carriers.push(if driven { next } else { carrier });

        let turns_only = steps.iter().all(|step| step.motion == Motion::Turn);
        // Where drives require an order of motions from the ground outwards, a joint declared inwards lists them in
        // reverse, if its keyword allows it. The motions of a cylindrical joint commute.
        let reversible = !driven || turns_only || steps.len() == 1 || word == Word::Cylindrical;
        let body = Frame::Body(index);
        let mut ends = [(parent, inboard), (body, outboard)];
        let inwards = if self.source.frames == Frames::Aligned { 0.05 } else { 0.25 };
        if reversible && self.source.random.chance(inwards) {
            ends.reverse();
            if driven && turns_only {
                steps.reverse();
            }
        }
        let [(from, from_placement), (to, to_placement)] = ends;
        self.joints.push(Joint { from_placement, to_placement, ..Joint::new("", word, steps, from, to) });
    }
}
