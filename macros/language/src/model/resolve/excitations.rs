//! Harmonic excitations: unbalances of turning bodies, harmonic forces, shaken joints.

use std::rc::Rc;

use proc_macro2::Ident;

use super::arguments::{Arguments, Signature};
use super::expected::Expected;
use super::joints::kinds::Kind;
use super::placements::zero;
use super::resolver::Resolver;
use crate::base::dimension::Dimension;
use crate::base::ids::{CoordinateId, JointId};
use crate::model::expression::Expr;
use crate::model::mechanism::{CoordinateQuantity, Deviation, Excitation, ExcitationLaw, Frame, Frequency, ShakenBy};
use crate::model::rules::physical::Demand;
use crate::syntax::ast::{self, Ast, Force, ItemKind, Joint, JointClause, NamedCall, Shake, Unbalance, Value};
use crate::syntax::parse::GRADE;

const UNBALANCE: &[Signature<()>] =
    &[Signature::new("unbalance", &[], "unbalance u: on disk, amount: 20 g*mm, angle: 30 deg;", ())
        .optional(&["angle", "service"])
        .exactly_one(&["amount", "eccentricity", "tilt", "grade"])
        .refusing(&[
            ("mass", "an unbalance is a mass times its distance from the axis: `amount: 20 g*mm`"),
            ("phase", "the phase of an unbalance is its `angle`"),
            ("order", "an unbalance turns with its body"),
            ("frequency", "an unbalance turns with its body"),
        ])];

const SHAKEN: &[Signature<()>] = &[Signature::new("shaken", &[], "shaken(amplitude: 1 mm, frequency: 50 Hz)", ())
    .optional(&["frequency", "order", "phase"])
    .exactly_one(&["amplitude", "velocity", "acceleration"])];

fn shakes(joint: &Joint) -> impl Iterator<Item = &Shake> {
    joint.clauses.iter().filter_map(|clause| match clause {
        JointClause::Shake(shake) => Some(shake),
        _ => None,
    })
}

/// The number of declared excitations.
pub(super) fn declared(ast: &Ast) -> usize {
    let of = |item: &ast::Item| match &item.kind {
        ItemKind::Unbalance(_) => 1,
        ItemKind::Force(force) => usize::from(force.is_harmonic()),
        ItemKind::Joint(joint) => shakes(joint).count(),
        _ => 0,
    };
    ast.items.iter().map(of).sum()
}

impl Resolver<'_> {
    /// All excitations in order of declaration.
    pub(super) fn excitations(&mut self) -> Vec<Excitation> {
        let (mut excitations, mut joints) = (Vec::new(), 0);
        for item in &self.ast.items {
            match &item.kind {
                ItemKind::Unbalance(unbalance) => excitations.extend(self.unbalance(unbalance)),
                ItemKind::Force(force) if force.is_harmonic() => {
                    excitations.extend(self.harmonic(force));
                }
                ItemKind::Joint(joint) => {
                    let id = JointId::new(joints);
                    joints += 1;
                    for shake in shakes(joint) {
                        excitations.extend(self.shaken(joint, id, shake));
                    }
                }
                _ => {}
            }
        }
        excitations
    }

    fn unbalance(&mut self, unbalance: &Unbalance) -> Option<Excitation> {
        let arguments = self.arguments(&unbalance.call, &UNBALANCE[0]);
        let frame = self.frame(&unbalance.on);
        let at = match &unbalance.at {
            Some(at) => self.position(at, "the place of an unbalance"),
            None => Some(zero()),
        };
        let phase = self.phase(&arguments, "angle");
        let first_moment = Dimension::new(1, 1, 0);
        let amount = self.amplitude(&arguments, "amount", first_moment);
        let eccentricity = self.amplitude(&arguments, "eccentricity", Dimension::LENGTH);
        let eccentricity = eccentricity.or(self.graded(&arguments, unbalance));
        let tilt = self.amplitude(&arguments, "tilt", Expected::angle());
        let moves_the_body = eccentricity.is_some() || tilt.is_some();
        let deviation =
            amount.map(Deviation::Amount).or(eccentricity.map(Deviation::Eccentricity)).or(tilt.map(Deviation::Tilt));
        if let (Some(at), Some(Deviation::Eccentricity(_) | Deviation::Tilt(_))) = (&unbalance.at, &deviation) {
            let message = "an eccentricity or a tilt moves the whole body: it has no place";
            return self.refuse(at.extent, message);
        }
        if moves_the_body && self.is_massless(&unbalance.on) {
            let message = format!("`{}` has no mass that could be out of place", unbalance.on);
            let help = "give the `amount` of the unbalance, or name the body that has the mass";
            return self.refuse_with_help(&unbalance.on, message, help);
        }
        let Frame::Body(body) = frame? else {
            let message = "the ground does not turn";
            let help = "an unbalance is `on` a body that a drive turns";
            return self.refuse_with_help(&unbalance.on, message, help);
        };
        Some(Excitation {
            name: unbalance.name.clone(),
            law: ExcitationLaw::Unbalance { body, at: at?, deviation: deviation? },
            frequency: Frequency::OfTurning,
            phase: phase?,
        })
    }

    /// The eccentricity that a grade of balancing allows at the service speed (ISO 21940-11).
    fn graded(&mut self, arguments: &Arguments, unbalance: &Unbalance) -> Option<Expr> {
        let grade = self.amplitude(arguments, "grade", Dimension::new(1, 0, -1));
        match (arguments.get("grade"), arguments.get("service")) {
            (Some(_), Some(service)) => {
                let service = self.positive(service, Dimension::RATE, "`service`")?;
                Some(Expr::Divide(Rc::new(grade?), Rc::new(service)))
            }
            (Some(grade), None) => {
                let message = "a grade of balancing holds at a service speed";
                self.refuse_with_help(grade.extent, message, GRADE)
            }
            (None, Some(service)) => {
                let message = format!("`service` is the speed of a `grade`, and `{}` has none", unbalance.name);
                self.refuse(service.extent, message)
            }
            (None, None) => None,
        }
    }

    fn is_massless(&self, body: &Ident) -> bool {
        let declared = self.ast.all::<ast::Body>().find(|x| x.name == *body);
        declared.is_some_and(|declared| declared.terms.iter().all(|term| term.shape.word == "massless"))
    }

    fn harmonic(&mut self, force: &Force) -> Option<Excitation> {
        let signature = super::forces::LAWS.iter().find(|row| force.law.word == row.word)?;
        let arguments = self.arguments(&force.law, signature);
        let frequency = self.frequency(&arguments, &force.law);
        let phase = self.phase(&arguments, "phase");
        let law = match (arguments.get("at"), arguments.get("on")) {
            (Some(_), None) => {
                let point = self.moving_point(&arguments, "nothing moves under a force there");
                let load = self.vector_or_zero(&arguments, "force", Dimension::FORCE);
                let moment = self.vector_or_zero(&arguments, "moment", Expected::moment());
                if arguments.get("force").or(arguments.get("moment")).is_none() {
                    let message = "`harmonic` at a point needs a `force` or a `moment`";
                    return self.refuse(arguments.get("at")?.extent, message);
                }
                Some(ExcitationLaw::Load { point: point?, force: load?, moment: moment? })
            }
            (None, Some(_)) => {
                let (coordinate, quantity) = self.free_coordinate("force", &arguments)?;
                let (name, other, dimension): (_, _, Expected) = quantity.either(("moment", "force", Expected::moment()), ("force", "moment", Dimension::FORCE.into()));
                if let Some(value) = arguments.get(other) {
                    let message = format!("along this coordinate a `{name}` acts, not a `{other}`");
                    return self.refuse(value.extent, message);
                }
                if arguments.get(name).is_none() {
                    let message = format!("`harmonic` on this coordinate needs a `{name}`");
                    return self.refuse(&force.law.word, message);
                }
                let value = self.amplitude(&arguments, name, dimension)?;
                Some(ExcitationLaw::Generalized { coordinate, value })
            }
            _ => {
                self.refuse_with_help(
                    &force.law.word,
                    "`harmonic` acts `at` a point or `on` a coordinate",
                    "write `harmonic(at: p, force: [0, 0, 1] N, frequency: 50 Hz)` or `harmonic(on: theta, moment: 1 N*m, frequency: 50 Hz)`",
                )
            }
        };
        Some(Excitation { name: force.name.clone(), law: law?, frequency: frequency?, phase: phase? })
    }

    fn shaken(&mut self, joint: &Joint, id: JointId, shake: &Shake) -> Option<Excitation> {
        if shake.call.word != "shaken" {
            return None;
        }
        let arguments = self.arguments(&shake.call, &SHAKEN[0]);
        let frequency = self.frequency(&arguments, &shake.call);
        let phase = self.phase(&arguments, "phase");
        let coordinate = self.shaken_coordinate(joint, id, shake)?;
        let declared = self.coordinates.get(coordinate.index())?;
        let (name, quantity) = (declared.name.clone(), declared.quantity?);
        let length = quantity.either(0, 1);
        let expected = |time: i16| match (length, time) {
            (0, 0) => Expected::angle(),
            (length, time) => Dimension::new(length, 0, time).into(),
        };
        let measures = [
            ("amplitude", ShakenBy::Displacement, expected(0)),
            ("velocity", ShakenBy::Velocity, expected(-1)),
            ("acceleration", ShakenBy::Acceleration, expected(-2)),
        ];
        let given = measures.into_iter().find(|(name, ..)| arguments.get(name).is_some());
        let (word, measure, expected) = given?;
        let amplitude = self.amplitude(&arguments, word, expected)?;
        Some(Excitation {
            name,
            law: ExcitationLaw::Shaken { coordinate, measure, amplitude },
            frequency: frequency?,
            phase: phase?,
        })
    }

    /// The coordinate that a clause shakes; what is wrong with the clause has been reported with the drives.
    fn shaken_coordinate(&mut self, joint: &Joint, id: JointId, shake: &Shake) -> Option<CoordinateId> {
        Kind::find(&joint.kind.to_string())?;
        let ids = self.coordinates_of(id);
        match &shake.coordinate {
            None => (ids.len() == 1).then(|| ids[0]),
            Some(name) => ids.into_iter().find(|id| self.coordinates.get(id.index()).is_some_and(|x| x.name == name)),
        }
    }

    /// `frequency: VALUE` or `order: VALUE of DRIVE`, both positive.
    fn frequency(&mut self, arguments: &Arguments, call: &NamedCall) -> Option<Frequency> {
        let word = &call.word;
        match (arguments.get("frequency"), arguments.get("order")) {
            (Some(value), None) => {
                let expr = self.positive(value, Dimension::RATE, "`frequency`")?;
                Some(Frequency::Own(expr))
            }
            (None, Some(value)) => {
                let order = self.positive(value, Expected::ratio(), "`order`");
                let Some(of) = arguments.of else {
                    return self.refuse_with_help(
                        value.extent,
                        "an order is counted in turns of a drive",
                        "write `order: 2 of spin`, where `spin` is a driven or coasting coordinate",
                    );
                };
                let coordinate = self.running_coordinate(of)?;
                Some(Frequency::Order(order?, coordinate))
            }
            (Some(_), Some(_)) => {
                let message = format!("`{word}` takes `frequency` or `order`, not both");
                self.refuse(word, message)
            }
            (None, None) => self.refuse_with_help(
                word,
                format!("`{word}` needs `frequency` or `order`"),
                "write `frequency: 50 Hz`, or `order: 2 of spin`",
            ),
        }
    }

    /// A coordinate that keeps turning.
    fn running_coordinate(&mut self, name: &Ident) -> Option<CoordinateId> {
        let (id, quantity) = self.coordinate(name)?;
        if quantity != CoordinateQuantity::Angle || !self.runs(id)? {
            let message = format!("`{name}` does not turn at a speed of its own");
            let help = "an order is counted in turns of a driven or coasting coordinate";
            return self.refuse_with_help(name, message, help);
        }
        Some(id)
    }

    fn phase(&mut self, arguments: &Arguments, name: &str) -> Option<Expr> {
        self.coefficient_or_zero(arguments, name, Some(Expected::angle()))
    }

    /// An amplitude, which must not be negative, if it is given.
    fn amplitude(&mut self, arguments: &Arguments, name: &str, expected: impl Into<Expected>) -> Option<Expr> {
        let value = arguments.get(name)?;
        let expected = expected.into();
        let demand = Demand::Amplitude(expected.dimension);
        self.demanded(value, expected, &format!("`{name}`"), demand)
    }

    fn positive(&mut self, value: &Value, expected: impl Into<Expected>, what: &str) -> Option<Expr> {
        let expected = expected.into();
        let demand = Demand::Positive(expected.dimension);
        self.demanded(value, expected, what, demand)
    }

    fn demanded(&mut self, value: &Value, expected: Expected, what: &str, demand: Demand) -> Option<Expr> {
        let expr = self.scalar_of(value, expected, what)?;
        self.require(what, [expr.clone()], demand, value.extent);
        Some(expr)
    }
}
