//! Force elements: the table of laws. Each family of laws has its own file.
//!
//! # "Every" means one force on each coordinate
//!
//! `every angle: spring(..)` is expanded where forces are resolved. Such forces do not keep a joint from being cut;
//! those on a cut joint are dropped once the topology is known. After `kernels only` the derivation lists the
//! coordinates that nothing resists or that move no mass (`Functions::undetermined`) instead of rejecting them.

mod at_points;
mod between_points;
mod by_expression;
mod on_coordinates;

use super::arguments::{Arguments, Signature};
use super::expected::Expected;
use super::placements::zero;
use super::resolver::Resolver;
use super::typed::ValueContext;
use crate::model::expression::{Expr, Matrix, Vector};
use crate::model::mechanism::{Force, ForceLaw};
use crate::syntax::ast;

const BETWEEN_POINTS: &str = "between two points it is `spring_damper`";
const ON_A_COORDINATE: [(&str, &str); 1] = [("on", "along a coordinate it is `generalized`")];

/// How the arguments of a word are read.
#[derive(Clone, Copy)]
pub(super) enum Reader {
    /// By a function that makes a law of them.
    Law(fn(&mut Resolver<'_>, &Arguments<'_>) -> Option<ForceLaw>),
    /// With the excitations.
    Excitation,
}

pub(super) type Row = Signature<Reader>;

pub(super) const LAWS: &[Row] =
    &[
        Row::new(
            "spring",
            &["on", "stiffness"],
            "spring(on: theta, stiffness: 10 N*m/rad)",
            Reader::Law(|resolver, arguments| resolver.spring(arguments)),
        )
        .optional(&["rest"])
        .refusing(&[
            ("damping", "add a `damper` on the same coordinate"),
            ("from", BETWEEN_POINTS),
            ("to", BETWEEN_POINTS),
        ]),
        Row::new(
            "damper",
            &["on", "damping"],
            "damper(on: theta, damping: 0.1 N*m*s/rad)",
            Reader::Law(|resolver, arguments| resolver.damper(arguments)),
        )
        .refusing(&[("from", BETWEEN_POINTS), ("to", BETWEEN_POINTS)]),
        Row::new(
            "inerter",
            &["on", "inertance"],
            "inerter(on: theta, inertance: 0.1 kg*m^2)",
            Reader::Law(|resolver, arguments| resolver.inerter(arguments)),
        )
        .refusing(&[("from", BETWEEN_POINTS), ("to", BETWEEN_POINTS)]),
        Row::new(
            "spring_damper",
            &["from", "to", "stiffness"],
            "spring_damper(from: p, to: q, stiffness: 100 N/m)",
            Reader::Law(|resolver, arguments| resolver.spring_damper(arguments)),
        )
        .optional(&["damping", "length"])
        .refusing(&[("on", "on a coordinate there are `spring` and `damper`")]),
        Row::new(
            "tension",
            &["from", "to", "law"],
            "tension(from: p, to: q, law: 100 N/m * (length - 1 m))",
            Reader::Law(|resolver, arguments| resolver.tension(arguments)),
        ),
        Row::new(
            "generalized",
            &["on", "value"],
            "generalized(on: theta, value: -1 N*m * sin(theta))",
            Reader::Law(|resolver, arguments| resolver.generalized(arguments)),
        ),
        Row::new(
            "potential",
            &["energy"],
            "potential(energy: 1 J * cos(theta))",
            Reader::Law(|resolver, arguments| resolver.potential(arguments)),
        ),
        Row::new(
            "bushing",
            &["from", "to"],
            "bushing(from: p, to: q, stiffness: [1, 1, 1] kN/m)",
            Reader::Law(|resolver, arguments| resolver.bushing(arguments)),
        )
        .at_least_one(&["stiffness", "damping", "turning_stiffness", "turning_damping"]),
        Row::new(
            "load",
            &["at"],
            "load(at: p, force: [0, 0, -1] N)",
            Reader::Law(|resolver, arguments| resolver.load(arguments, false)),
        )
        .at_least_one(&["force", "moment"])
        .refusing(&ON_A_COORDINATE),
        Row::new(
            "follower",
            &["at"],
            "follower(at: p, force: [0, 0, -1] N)",
            Reader::Law(|resolver, arguments| resolver.load(arguments, true)),
        )
        .at_least_one(&["force", "moment"])
        .refusing(&ON_A_COORDINATE),
        Row::new(
            "drag",
            &["at"],
            "drag(at: p, damping: 1 N*s/m)",
            Reader::Law(|resolver, arguments| resolver.drag(arguments)),
        )
        .at_least_one(&["damping", "turning_damping"]),
        Row::new(
            "distributed",
            &["on"],
            "distributed(on: blade, force: [0, 0, -5] N/m)",
            Reader::Law(|resolver, arguments| resolver.distributed(arguments)),
        )
        .at_least_one(&["force", "follower", "damping"]),
        Row::new("harmonic", &[], "harmonic(at: p, force: [0, 0, 1] N, frequency: 50 Hz)", Reader::Excitation)
            .optional(&["at", "on", "force", "moment", "frequency", "order", "phase"]),
    ];

/// Names of the laws in other tools.
const SYNONYMS: [(&str, &str); 27] = [
    ("armature", "inerter"),
    ("rotor_inertia", "inerter"),
    ("shaker", "harmonic"),
    ("excitation", "harmonic"),
    ("sine", "harmonic"),
    ("torsion_spring", "spring"),
    ("torsional_spring", "spring"),
    ("rotational_spring", "spring"),
    ("rotary_spring", "spring"),
    ("dashpot", "damper"),
    ("damping", "damper"),
    ("strut", "spring_damper"),
    ("shock", "spring_damper"),
    ("tsda", "spring_damper"),
    ("cable", "tension"),
    ("rope", "tension"),
    ("tendon", "tension"),
    ("energy", "potential"),
    ("bearing", "bushing"),
    ("mount", "bushing"),
    ("beam", "bushing"),
    ("force", "load"),
    ("torque", "load"),
    ("moment", "load"),
    ("thrust", "follower"),
    ("motor", "generalized"),
    ("actuator", "generalized"),
];

impl Resolver<'_> {
    pub(super) fn forces(&mut self) -> Vec<Force> {
        let mut forces = Vec::new();
        for force in self.ast.all::<ast::Force>() {
            let law = self.law(force);
            forces.extend(law.map(|law| Force { name: force.name.clone(), law, of_every: false }));
        }
        forces
    }

    fn law(&mut self, force: &ast::Force) -> Option<ForceLaw> {
        let signature = self.signature(&force.law, "force law", LAWS, &SYNONYMS)?;
        let Reader::Law(read) = signature.read else {
            return None;
        };
        let arguments = self.arguments(&force.law, signature);
        read(self, &arguments)
    }

    /// A required argument. Its dimension is unknown if the coordinate is; then only the value is checked.
    pub(super) fn coefficient(
        &mut self,
        arguments: &Arguments,
        name: &str,
        expected: impl Into<Option<Expected>>,
    ) -> Option<Expr> {
        let value = arguments.get(name)?;
        let Some(expected) = expected.into() else {
            self.scalar(value, ValueContext::Parameter);
            return None;
        };
        let what = format!("`{name}`");
        let expr = self.scalar_of(value, expected, &what)?;
        self.require_finite(std::slice::from_ref(&expr), &what, value.extent);
        Some(expr)
    }

    /// Like `coefficient`, but zero if not given.
    pub(super) fn coefficient_or_zero(
        &mut self,
        arguments: &Arguments,
        name: &str,
        expected: impl Into<Option<Expected>>,
    ) -> Option<Expr> {
        match arguments.get(name) {
            Some(_) => self.coefficient(arguments, name, expected),
            None => Some(Expr::Number(0.0)),
        }
    }

    /// A vector; zero if not given.
    pub(super) fn vector_or_zero(
        &mut self,
        arguments: &Arguments,
        name: &str,
        expected: impl Into<Expected>,
    ) -> Option<Vector> {
        match arguments.get(name) {
            Some(value) => self.vector_of(value, expected, &format!("`{name}`")),
            None => Some(zero()),
        }
    }

    /// A matrix, or a vector for its diagonal; zero if not given.
    fn matrix_or_zero(
        &mut self,
        arguments: &Arguments,
        name: &str,
        expected: impl Into<Expected>,
    ) -> Option<Box<Matrix>> {
        let matrix = match arguments.get(name) {
            Some(value) => self.matrix_of(value, expected, &format!("`{name}`"))?,
            None => [zero(), zero(), zero()],
        };
        Some(Box::new(matrix))
    }
}
