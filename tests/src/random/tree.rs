//! Random trees of bodies.

use super::values::Source;
use super::{Plan, Random, Setting};
use crate::model::{
    Body, Drive, Frame, Input, Joint, JointKind, Model, Placement, Shape, Unit, Values,
};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

pub(super) struct Builder {
    pub(super) source: Source,
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    inputs: Vec<Input>,
    /// Of each body: how many drives carry it, counted so that bodies with equal numbers are steady relative to each
    /// other. The ground has 0.
    pub(super) carriers: Vec<usize>,
}

impl Builder {
    pub(super) fn new(random: Random) -> Self {
        Self {
            source: Source {
                random,
                design: Vec::new(),
            },
            bodies: Vec::new(),
            joints: Vec::new(),
            inputs: Vec::new(),
            carriers: Vec::new(),
        }
    }

    pub(super) fn build(mut self, plan: &Plan) -> Model {
        let gravity = self.gravity(plan.setting);
        self.driven_bodies(plan.setting);
        let trunk = self.bodies.len();
        for _ in 0..plan.bodies {
            self.free_body(plan.setting, trunk);
        }
        if plan.rotor {
            self.rotor();
        }
        self.give_leaves_mass();
        self.source.random.shuffle(&mut self.joints);
        for (index, joint) in self.joints.iter_mut().enumerate() {
            joint.name = format!("joint{index}");
        }
        let (points, forces) = self.forces();
        Model {
            name: "Tree".to_owned(),
            inputs: self.inputs,
            design: self.source.design,
            gravity,
            bodies: self.bodies,
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

    /// The bodies that drives put in motion.
    fn driven_bodies(&mut self, setting: Setting) {
        match setting {
            Setting::Still => {}
            Setting::Spinning => self.shaft(Frame::Ground),
            Setting::Conveyed => {
                let axis = self.source.axis();
                let (inboard, outboard) = (self.source.placement(), self.source.placement());
                self.drive(
                    JointKind::Prismatic(axis),
                    Frame::Ground,
                    [inboard, outboard],
                );
            }
            Setting::Climbing => {
                let (inboard, outboard) = (self.upright(), self.upright());
                self.drive(JointKind::Prismatic(Z), Frame::Ground, [inboard, outboard]);
                self.shaft(Frame::Body(0));
            }
        }
    }

    /// A body driven about the vertical.
    fn shaft(&mut self, parent: Frame) {
        let axis =
            [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 2.5]][self.source.random.below(3)];
        let (inboard, outboard) = (self.upright(), self.source.placement());
        self.drive(JointKind::Revolute(axis), parent, [inboard, outboard]);
    }

    /// A placement that leaves z vertical.
    fn upright(&mut self) -> Placement {
        let offset = self.source.position(0.5);
        let angle = self.source.between(-2.0, 2.0, Unit::Radian);
        let turned = self.source.random.chance(0.5);
        Placement {
            offset,
            rotations: if turned { vec![(Z, angle)] } else { Vec::new() },
        }
    }

    /// A driven body, massless or not; its input may drive another one as well.
    fn drive(&mut self, kind: JointKind, parent: Frame, placements: [Placement; 2]) {
        let unit = match kind {
            JointKind::Prismatic(_) => Unit::MetrePerSecond,
            _ => Unit::RadianPerSecond,
        };
        let shared = self.inputs.iter().position(|input| input.unit == unit);
        let input = match shared {
            Some(input) if self.source.random.chance(0.5) => input,
            _ => {
                let name = format!("u{}", self.inputs.len());
                self.inputs.push(Input { name, unit });
                self.inputs.len() - 1
            }
        };
        let factor = if self.source.random.chance(0.5) {
            1.0
        } else {
            -0.7
        };
        let shape = if self.source.random.chance(0.6) {
            Shape::Massless
        } else {
            self.source.shape()
        };
        self.add(
            shape,
            kind,
            parent,
            placements,
            Some(Drive { input, factor }),
        );
    }

    fn free_body(&mut self, setting: Setting, trunk: usize) {
        let random = &mut self.source.random;
        let beside = setting == Setting::Still || random.chance(0.15);
        let parent = if self.bodies.is_empty() || (beside && random.chance(0.4)) {
            Frame::Ground
        } else if random.chance(0.5) {
            // A long chain.
            Frame::Body(self.bodies.len() - 1)
        } else {
            Frame::Body(
                trunk.saturating_sub(1) + random.below(self.bodies.len() - trunk.saturating_sub(1)),
            )
        };
        let axis = self.source.axis();
        let kind = match self.source.random.below(10) {
            0 => JointKind::Fixed,
            1..=3 => JointKind::Prismatic(axis),
            _ => JointKind::Revolute(axis),
        };
        let placements = [self.source.placement(), self.source.placement()];
        // Leaves get their mass at the end.
        let shape = if self.source.random.chance(0.2) {
            Shape::Massless
        } else {
            self.source.shape()
        };
        self.add(shape, kind, parent, placements, None);
    }

    /// A body that spins about its own axis of symmetry, on any body.
    fn rotor(&mut self) {
        let axis = self.source.axis();
        let parent = Frame::Body(self.bodies.len() - 1);
        let mut placements = [self.source.placement(), Placement::NONE];
        // The joint may sit elsewhere on the axis of symmetry.
        let along = self.source.random.between(-0.4, 0.4);
        let on_axis = axis.map(|component| crate::model::Value::Number(along * component));
        placements[1].offset = on_axis;
        self.drive(JointKind::Revolute(axis), parent, placements);
        let rotor = self.source.rotor(axis);
        if let Some(body) = self.bodies.last_mut() {
            body.shape = rotor;
        }
    }

    fn give_leaves_mass(&mut self) {
        for index in 0..self.bodies.len() {
            let frame = Frame::Body(index);
            let degree = self
                .joints
                .iter()
                .filter(|j| j.from == frame || j.to == frame)
                .count();
            if degree < 2 && self.bodies[index].shape == Shape::Massless {
                self.bodies[index].shape = self.source.shape();
            }
        }
    }

    /// Adds a body and its joint, declared in either direction.
    fn add(
        &mut self,
        shape: Shape,
        kind: JointKind,
        parent: Frame,
        [inboard, outboard]: [Placement; 2],
        drive: Option<Drive>,
    ) {
        let body = self.bodies.len();
        self.bodies.push(Body {
            name: format!("body{body}"),
            shape,
        });
        let carrier = match parent {
            Frame::Ground => 0,
            Frame::Body(parent) => self.carriers[parent],
        };
        let next = 1 + self.carriers.iter().copied().max().unwrap_or(0);
        self.carriers
            .push(if drive.is_some() { next } else { carrier });
        let body = Frame::Body(body);
        let ((from, from_placement), (to, to_placement)) = if self.source.random.chance(0.25) {
            ((body, outboard), (parent, inboard))
        } else {
            ((parent, inboard), (body, outboard))
        };
        let name = String::new();
        self.joints.push(Joint {
            name,
            kind,
            from,
            to,
            from_placement,
            to_placement,
            drive,
        });
    }
}
