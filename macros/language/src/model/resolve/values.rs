//! Values: names become ids, units are converted to SI, and dimensions are checked at every operator.

use proc_macro2::Ident;

use super::bare::bare_number;
use super::coordinates::{self, DeclaredMotion};
use super::expected::Expected;
use super::matrices::is_matrix;
use super::resolver::Resolver;
use super::scope::Meaning;
use super::tension;
use super::typed::{Quantity, Typed, ValueContext};
use crate::base::dimension::Dimension;
use crate::base::ids::CoordinateId;
use crate::base::nearest::nearest;
use crate::base::span::Extent;
use crate::base::units;
use crate::model::expression::{Expr, Vector};
use crate::model::simplify;
use crate::syntax::ast::{ItemKind, Unit, Value, ValueKind};

/// All functions below return `None` for a mistake that has been reported.
impl Resolver<'_> {
    /// A value of any kind and dimension.
    pub(super) fn value(&mut self, value: &Value, value_context: ValueContext) -> Option<Typed> {
        match &value.kind {
            ValueKind::Number(number, unit) => self.number(*number, unit.as_ref(), value_context),
            ValueKind::Name(name) => self.named_value(name, value_context),
            ValueKind::Vector(components, unit) => {
                self.vector_literal(components, unit.as_ref(), value.extent, value_context)
            }
            ValueKind::Negate(operand) => {
                let operand = self.value(operand, value_context)?;
                let quantity = operand.quantity();
                Some(operand.map(simplify::negate, quantity))
            }
            ValueKind::Binary(binary) => self.binary(binary, value_context),
            ValueKind::Call(function, arguments) => self.call(function, arguments, value_context),
            ValueKind::Component(of, axis) => self.component(of, axis, value_context),
            ValueKind::Parenthesised(inner) => self.value(inner, value_context),
            ValueKind::Sections(_) => {
                let message = "a cross-section belongs to a beam";
                self.refuse(value.extent, message)
            }
            ValueKind::File(name) => {
                let message = format!("`{name}` is a file, where a value is expected");
                let help = "tables stand at `sections` of a `shaft`, matrices in a `superelement`";
                self.refuse_with_help(value.extent, message, help)
            }
            ValueKind::Fraction(_) | ValueKind::Station(_) => {
                let message = "a fraction of a length is a place on a beam, a station one on a shaft";
                self.refuse(value.extent, message)
            }
        }
    }

    fn number(&mut self, number: f64, unit: Option<&Unit>, value_context: ValueContext) -> Option<Typed> {
        let Some(unit) = unit else {
            let quantity = if number == 0.0 { Quantity::Zero } else { Quantity::Of(Dimension::NONE) };
            return Some(Typed::Scalar(Expr::Number(number), quantity));
        };
        let (dimension, scale) = self.unit(unit)?;
        self.may_be_unclear(Some(number), unit, value_context);
        let value = number * scale;
        if !value.is_finite() {
            return self.refuse(unit.extent, "this value is outside the range of a 64-bit number");
        }
        // Tolerances are no lengths of the mechanism, and nominal values are noted by those who ask for them.
        if value_context != ValueContext::Nominal {
            self.note_length(value, dimension);
        }
        Some(Typed::number(value, dimension))
    }

    fn named_value(&mut self, name: &Ident, value_context: ValueContext) -> Option<Typed> {
        let text = name.to_string();
        if text == "pi" {
            return Some(Typed::number(std::f64::consts::PI, Dimension::NONE));
        }
        if value_context == ValueContext::Tension
            && let Some(word) = tension::word(&text)
        {
            return self.tension_word(word, name);
        }
        let Some(meaning) = self.scope.find_or_unclear(&text) else {
            self.unknown_value(name, value_context);
            return None;
        };
        if let Some((what, help)) = of_numbers_only(value_context)
            && meaning != Meaning::Unclear
        {
            let message = format!("`{text}` is {}; {what} made of numbers only", meaning.describe());
            return self.refuse_with_help(name, message, help);
        }
        match meaning {
            Meaning::Input(id) => {
                self.used.insert(text);
                let dimension = (*self.inputs.get(id.index())?)?;
                Some(Typed::Scalar(Expr::Input(id), Quantity::Of(dimension)))
            }
            Meaning::Design(id) => {
                self.used.insert(text);
                let dimension = self.design.get(id.index())?.as_ref()?.dimension;
                Some(Typed::Scalar(Expr::Design(id), Quantity::Of(dimension)))
            }
            Meaning::Let(index) => self.lets.get(index)?.clone(),
            Meaning::Joint(_) | Meaning::OnlyCoordinate(_) | Meaning::Coordinate(_) => {
                let (coordinate, quantity) = self.coordinate(name)?;
                self.coordinate_is_usable(name, coordinate, value_context)?;
                Some(Typed::Scalar(Expr::Coordinate(coordinate), Quantity::Of(coordinates::dimension(quantity))))
            }
            Meaning::Point(_) if value_context.knows_places() => self.refuse_with_help(
                name,
                format!("`{text}` is a point, not a value"),
                format!("its position in the ground frame is `position({text})`"),
            ),
            Meaning::Output => self.refuse_with_help(
                name,
                format!("`{text}` is an output; a value cannot use outputs"),
                "repeat its expression, or name the shared part with `let`",
            ),
            Meaning::Curve(_) => self.refuse_with_help(
                name,
                format!("`{text}` is a curve, not a value"),
                format!("write `{text}(...)` with what it depends on in the parentheses"),
            ),
            // Already reported at its declaration.
            Meaning::Unclear => None,
            Meaning::Body(_)
            | Meaning::Point(_)
            | Meaning::Force(_)
            | Meaning::Excitation
            | Meaning::Material
            | Meaning::Constraint(_) => {
                let help = match meaning {
                    Meaning::Constraint(_) => {
                        format!("what it exerts is an output: `reaction({text})` or `reaction_force({text})`")
                    }
                    Meaning::Material => {
                        "it is the `material` of a beam; name a number by `design` or `let`".to_string()
                    }
                    Meaning::Force(_) | Meaning::Excitation => {
                        "repeat its expression, or name the shared part with `let`".to_string()
                    }
                    Meaning::Point(_) => {
                        format!("where it is, `position({text})`, is known in outputs and forces only")
                    }
                    _ => format!(
                        "for a place in it declare `point p: {text};` and use `position(p)`; give a mass or a length a name by `design` or `let`"
                    ),
                };
                let message = format!("`{text}` is {}, not a value", meaning.describe());
                self.refuse_with_help(name, message, help)
            }
        }
    }

    /// Whether coordinates may be used here. A coasting one may be used only in equations: nothing else may depend
    /// on how far it has gone.
    fn coordinate_is_usable(
        &mut self,
        name: &Ident,
        coordinate: CoordinateId,
        value_context: ValueContext,
    ) -> Option<()> {
        let reason = match value_context {
            context if context.knows_places() => None,
            ValueContext::Tension => Some("a tension depends on `length` and `rate` only"),
            _ => Some("only outputs, generalized forces, potentials and equations may use coordinates"),
        };
        if let Some(reason) = reason {
            let message = format!("`{name}` is a coordinate; {reason}");
            return self.refuse(name, message);
        }
        let motion = self.coordinates.get(coordinate.index())?.motion;
        if motion == DeclaredMotion::Coasting && value_context != ValueContext::Equation {
            let rate = format!("use `rate({name})`");
            let help = (value_context != ValueContext::Energy).then_some(rate);
            let message = format!("`{name}` is coasting: nothing may depend on how far it has gone");
            return self.refuse_with(name, message, help);
        }
        Some(())
    }

    fn unknown_value(&mut self, name: &Ident, value_context: ValueContext) {
        let text = name.to_string();
        let usable = |meaning| match meaning {
            Meaning::Input(_) | Meaning::Design(_) | Meaning::Let(_) => of_numbers_only(value_context).is_none(),
            meaning => value_context.knows_places() && meaning.is_coordinate(),
        };
        let near = self.scope.nearest(&text, usable);
        let near = match value_context {
            ValueContext::Tension => near.or_else(|| nearest(&text, tension::words())),
            _ => near,
        };
        let help = match near {
            _ if ["t", "time"].contains(&text.as_str()) => Some(
                "there is no time here: equations hold in steady motion, where nothing changes, and for small vibrations about it"
                    .to_string(),
            ),
            Some(near) => Some(format!("did you mean `{near}`?")),
            None if units::respelt(&text).is_some() => {
                units::respelt(&text).map(|unit| format!("the unit is written `{unit}`"))
            }
            None if ["x", "y", "z"].contains(&text.as_str()) => Some(format!(
                "an axis can only stand where a direction is expected; as a vector write `{}`",
                match text.as_str() {
                    "x" => "[1, 0, 0]",
                    "y" => "[0, 1, 0]",
                    _ => "[0, 0, 1]",
                }
            )),
            None => None,
        };
        self.report(name, format!("unknown name `{text}`"), help);
    }

    fn vector_literal(
        &mut self,
        components: &[Value],
        unit: Option<&Unit>,
        extent: Extent,
        value_context: ValueContext,
    ) -> Option<Typed> {
        if let Some(unit) = unit {
            self.may_be_unclear(None, unit, value_context);
        }
        if is_matrix(components) {
            return self.matrix_literal(components, unit, extent, value_context);
        }
        let unit = self.optional_unit(unit);
        let resolved: Vec<_> = components.iter().map(|component| self.scalar(component, value_context)).collect();
        if components.len() != 3 {
            let count = components.len();
            let message = format!("a vector has 3 components, this one has {count}");
            let help = (count > 3 && decimal_commas(components)).then(|| DECIMAL_POINT.to_string());
            return self.refuse_with(extent, message, help);
        }
        let resolved: Vec<(Expr, Quantity)> = resolved.into_iter().collect::<Option<_>>()?;
        let (exprs, quantities): (Vec<Expr>, Vec<Quantity>) = resolved.into_iter().unzip();
        let common = self.common_quantity(&quantities, components, "components of a vector")?;
        let mut exprs = exprs.into_iter();
        let vector: Vector = [exprs.next()?, exprs.next()?, exprs.next()?];
        self.in_unit(Typed::Vector(vector, common), unit?, extent)
    }

    /// The dimension and scale of the unit after a vector or a matrix, if there is one.
    pub(super) fn optional_unit(&mut self, unit: Option<&Unit>) -> Option<Option<(Dimension, f64)>> {
        match unit {
            Some(unit) => self.unit(unit).map(Some),
            None => Some(None),
        }
    }

    /// The common quantity of all parts of a vector or a matrix; `what` names the parts in messages.
    pub(super) fn common_quantity(&mut self, quantities: &[Quantity], parts: &[Value], what: &str) -> Option<Quantity> {
        let mut common = Quantity::Zero;
        for (quantity, part) in quantities.iter().zip(parts) {
            match common.unify(*quantity) {
                Some(unified) => common = unified,
                None => {
                    let message = format!(
                        "the {what} have one dimension: this is {}, the one before is {}",
                        quantity.dimension().describe(),
                        common.dimension().describe()
                    );
                    let help = self.swallowed(part, quantity.dimension(), common.dimension());
                    return self.refuse_with(part.extent, message, help);
                }
            }
        }
        Some(common)
    }

    /// The bracketed values times the unit after the bracket.
    pub(super) fn in_unit(&mut self, typed: Typed, unit: Option<(Dimension, f64)>, extent: Extent) -> Option<Typed> {
        let Some((dimension, scale)) = unit else {
            return Some(typed);
        };
        let product = typed.quantity().dimension().times(dimension);
        let quantity = self.in_range(product, extent)?;
        for component in typed.components() {
            if let Expr::Number(value) = component {
                self.note_length(value * scale, quantity.dimension());
            }
        }
        let scaled = |expr| if scale == 1.0 { expr } else { simplify::multiply(Expr::Number(scale), expr) };
        Some(typed.map(scaled, quantity))
    }

    fn component(&mut self, of: &Value, axis: &Ident, value_context: ValueContext) -> Option<Typed> {
        let (vector, quantity) = self.vector(of, value_context)?;
        let [x, y, z] = vector;
        let component = match axis.to_string().as_str() {
            "x" => x,
            "y" => y,
            "z" => z,
            other => {
                let message = format!("a vector has no `{other}`; its components are x, y and z");
                return self.refuse(axis, message);
            }
        };
        Some(Typed::Scalar(component, quantity))
    }

    /// A value that must be one number.
    pub(super) fn scalar(&mut self, value: &Value, value_context: ValueContext) -> Option<(Expr, Quantity)> {
        match self.value(value, value_context)? {
            Typed::Scalar(expr, quantity) => Some((expr, quantity)),
            Typed::Vector(..) => self.refuse_with_help(
                value.extent,
                "a number is expected here, this is a vector",
                "take a component (`.x`) or the length (`norm`)",
            ),
            Typed::Matrix(..) => {
                let message = "a number is expected here, this is a matrix";
                self.refuse(value.extent, message)
            }
        }
    }

    /// A value that must be a vector.
    pub(super) fn vector(&mut self, value: &Value, value_context: ValueContext) -> Option<(Vector, Quantity)> {
        match self.value(value, value_context)? {
            Typed::Vector(vector, quantity) => Some((vector, quantity)),
            Typed::Scalar(..) => self.refuse_with_help(
                value.extent,
                "a vector is expected here, this is a number",
                "a vector is written `[1 m, 0, 0]`",
            ),
            Typed::Matrix(..) => self.refuse_with_help(
                value.extent,
                "this is a matrix; a vector of three numbers is expected here",
                "give the three values along the axes, `[a, b, c]`",
            ),
        }
    }

    /// A number that must have the given dimension; `what` names its role.
    pub(super) fn scalar_of(&mut self, value: &Value, expected: impl Into<Expected>, what: &str) -> Option<Expr> {
        let (expr, quantity) = self.scalar(value, ValueContext::Parameter)?;
        self.expect(quantity, expected, what, value)?;
        Some(expr)
    }

    /// A position in a frame.
    pub(super) fn position(&mut self, value: &Value, what: &str) -> Option<Vector> {
        self.vector_of(value, Dimension::LENGTH, what)
    }

    /// A vector that must have the given dimension; `what` names its role.
    pub(super) fn vector_of(&mut self, value: &Value, expected: impl Into<Expected>, what: &str) -> Option<Vector> {
        let (vector, quantity) = self.vector(value, ValueContext::Parameter)?;
        self.expect(quantity, expected, what, value)?;
        self.require_finite(&vector, what, value.extent);
        Some(vector)
    }

    /// Rejects a quantity of the wrong dimension; it is never converted, because it is a mistake in the model.
    pub(super) fn expect(
        &mut self,
        quantity: Quantity,
        expected: impl Into<Expected>,
        what: &str,
        value: &Value,
    ) -> Option<()> {
        let expected = expected.into();
        if expected.admits(quantity, value) {
            return match self.degrees(&expected, value) {
                None => Some(()),
                Some(number) => {
                    let message = format!("`{number}` has no unit and counts as radians: more than a turn");
                    let help = format!("write `{number} deg`, or `{number} rad` if that is meant");
                    self.refuse_with_help(value.extent, message, help)
                }
            };
        }
        if let Some(written) = bare_number(value) {
            return self.refuse(value.extent, expected.needs_unit(&written));
        }
        let message = format!("{what} must be {}, this is {}", expected.describe(), quantity.dimension().describe());
        let help = self
            .swallowed(value, quantity.dimension(), expected.dimension)
            .or_else(|| {
                let (name, number) = self.declared_without_unit(value)?;
                Some(match value.bare().kind {
                    ValueKind::Name(_) => {
                        format!("`{name}` is declared without a unit: write `{number} {}` there", expected.unit)
                    }
                    _ => format!("`{name}` is declared without a unit: `{number}`"),
                })
            })
            .or_else(|| {
                let weighed = quantity.dimension() == Dimension::FORCE;
                let weight = "what weighs 1 kgf has a mass of 1 kg, what weighs 1 lbf one of 1 lb";
                (weighed && expected.dimension == Dimension::MASS).then(|| weight.to_owned())
            });
        self.refuse_with(value.extent, message, help)
    }

    /// A number without a unit that is meant as degrees: an angle of more than a turn, written here or where it is declared.
    fn degrees(&self, expected: &Expected, value: &Value) -> Option<String> {
        let number = match value.bare().kind {
            ValueKind::Name(_) => self.declared_without_unit(value)?.1,
            _ => bare_number(value)?,
        };
        let beyond = number.parse::<f64>().is_ok_and(|angle| angle.abs() > std::f64::consts::TAU);
        (expected.is_angle() && beyond).then_some(number)
    }

    /// The first name in a value that is declared as a number without a unit, and that number.
    pub(super) fn declared_without_unit(&self, value: &Value) -> Option<(String, String)> {
        value.names().into_iter().find_map(|name| {
            let mut items = self.ast.items.iter();
            let declared = items.find_map(|item| match &item.kind {
                ItemKind::Design(design) if design.name == *name => Some(&design.nominal),
                ItemKind::Let(named) if named.name == *name => Some(&named.value),
                _ => None,
            })?;
            Some((name.to_string(), bare_number(declared)?))
        })
    }
}

/// The content of a place that admits no names, and advice on what to do there.
fn of_numbers_only(value_context: ValueContext) -> Option<(&'static str, &'static str)> {
    match value_context {
        ValueContext::Nominal => Some(("a nominal value is", "use `let` for a value computed from others")),
        ValueContext::Points => {
            Some(("the points of a curve are", "multiply the curve where it is used: `factor * stiffness(speed)`"))
        }
        ValueContext::Values => Some(("listed values are", "write the numbers themselves")),
        _ => None,
    }
}

/// Help for `3,5`.
pub(super) const DECIMAL_POINT: &str = "a fraction is written with a point: `3.5`, not `3,5`";

/// Whether a list has too many values, two of which may be one number with a decimal comma.
pub(super) fn decimal_commas(values: &[Value]) -> bool {
    let is_whole = |value: &Value| match value.kind {
        ValueKind::Number(number, None) => number.fract() == 0.0,
        _ => false,
    };
    let is_number = |value: &Value| matches!(value.kind, ValueKind::Number(..));
    values.windows(2).any(|pair| is_whole(&pair[0]) && is_number(&pair[1]))
}
