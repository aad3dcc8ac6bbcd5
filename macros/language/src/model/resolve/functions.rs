//! Functions: their table, and those that do not depend on the motion.

mod motion;
mod reactions;

use proc_macro2::Ident;

use super::resolver::Resolver;
use super::scope::Meaning;
use super::typed::{Quantity, Typed, ValueContext};
use super::values::{DECIMAL_POINT, decimal_commas};
use crate::base::dimension::Dimension;
use crate::base::nearest::{advice, meant};
use crate::model::expression::{Expr, Function};
use crate::model::simplify;
use crate::syntax::ast::Value;

/// What a function depends on, which determines where it may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Needs {
    /// Only its arguments.
    Arguments,
    /// The positions of the bodies.
    Places,
    /// The velocities of the bodies.
    Rates,
    /// The whole solution.
    Solution,
}

use Needs::{Arguments, Places, Rates, Solution};

/// Every function with its arguments.
const SIGNATURES: [(&str, &[&str], Needs); 27] = [
    ("sqrt", &["x"], Arguments),
    ("sin", &["angle"], Arguments),
    ("cos", &["angle"], Arguments),
    ("tan", &["angle"], Arguments),
    ("asin", &["x"], Arguments),
    ("acos", &["x"], Arguments),
    ("atan", &["x"], Arguments),
    ("atan2", &["y", "x"], Arguments),
    ("exp", &["x"], Arguments),
    ("ln", &["x"], Arguments),
    ("norm", &["vector"], Arguments),
    ("dot", &["a", "b"], Arguments),
    ("cross", &["a", "b"], Arguments),
    ("angle", &["a", "b"], Arguments),
    ("position", &["point"], Places),
    ("distance", &["point", "point"], Places),
    ("distance_from_axis", &["point", "direction"], Places),
    ("rate", &["coordinate"], Rates),
    ("reaction_force", &["joint"], Solution),
    ("reaction_moment", &["joint"], Solution),
    ("reaction", &["constraint"], Solution),
    ("curvature", &["point"], Solution),
    ("moment", &["point"], Solution),
    ("strain", &["point"], Solution),
    ("inner_force", &["point"], Solution),
    ("kinetic_energy", &[], Solution),
    ("potential_energy", &[], Solution),
];

/// Names of the functions in other tools and languages.
const SYNONYMS: [(&str, &str); 18] = [
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("arctan2", "atan2"),
    ("log", "ln"),
    ("length", "norm"),
    ("magnitude", "norm"),
    ("mag", "norm"),
    ("hypot", "norm"),
    ("velocity", "rate"),
    ("speed", "rate"),
    ("der", "rate"),
    ("multiplier", "reaction"),
    ("lambda", "reaction"),
    ("constraint_force", "reaction"),
    ("reaction_torque", "reaction_moment"),
    ("force", "reaction_force"),
    ("energy", "potential_energy"),
];

/// Results of a study, which cannot be declared.
const ABOUT_MODES: [&str; 12] = [
    "frequency",
    "frequencies",
    "freq",
    "natural_frequency",
    "omega",
    "eigenvalue",
    "eigenfrequency",
    "mode",
    "modes",
    "damping",
    "damping_ratio",
    "growth",
];
const MODES: &str = "frequencies and damping of modes are in every answer without being declared: `eigentol modes`, `study.modes()`; \
    an output is a value of the equilibrium, such as `theta` or `distance(p, q)`";

impl Resolver<'_> {
    pub(super) fn call(&mut self, function: &Ident, arguments: &[Value], value_context: ValueContext) -> Option<Typed> {
        let name = function.to_string();
        if let Some(Meaning::Curve(index)) = self.scope.find(&name) {
            return self.curve_at(index, function, arguments, value_context);
        }
        let known = SIGNATURES.iter().find(|(known, ..)| *known == name);
        let Some(&(name, parameters, needs)) = known else {
            let words = SIGNATURES.iter().map(|(known, ..)| *known);
            let is_curve = |meaning| matches!(meaning, Meaning::Curve(_));
            let help = if ABOUT_MODES.contains(&name.as_str()) {
                Some(MODES.to_string())
            } else {
                advice(&name, words, &SYNONYMS).or_else(|| self.scope.nearest(&name, is_curve).map(meant))
            };
            return self.refuse_with(function, format!("unknown function `{name}`"), help);
        };
        if arguments.len() != parameters.len() {
            let message = format!("`{name}` takes {}, not {}", count(parameters.len()), arguments.len());
            let mut help = format!("write `{name}({})`", parameters.join(", "));
            if arguments.len() > parameters.len() && decimal_commas(arguments) {
                help = format!("{help}; {DECIMAL_POINT}");
            }
            return self.refuse_with_help(function, message, help);
        }
        if let Some((message, help)) = refusal(name, needs, value_context) {
            return self.refuse_with(function, message, help);
        }
        let result = match needs {
            Arguments => self.of_arguments(name, function, arguments, value_context)?,
            _ => self.of_motion(name, function, arguments, value_context)?,
        };
        self.finite(result, function.into())
    }

    fn of_arguments(
        &mut self,
        name: &str,
        function: &Ident,
        arguments: &[Value],
        value_context: ValueContext,
    ) -> Option<Typed> {
        match (name, arguments) {
            ("norm", [a]) => {
                let (a, quantity) = self.vector(a, value_context)?;
                Some(Typed::Scalar(simplify::norm(&a), quantity))
            }
            ("dot" | "cross" | "angle", [a, b]) => {
                let (a, b) = (self.vector(a, value_context), self.vector(b, value_context));
                let ((a, of_a), (b, of_b)) = (a?, b?);
                if name == "angle" {
                    return Some(Typed::Scalar(simplify::angle(&a, &b), plain()));
                }
                let product = of_a.dimension().times(of_b.dimension());
                let quantity = self.in_range(product, function.into())?;
                Some(match name {
                    "dot" => Typed::Scalar(simplify::dot(&a, &b), quantity),
                    _ => Typed::Vector(simplify::cross(&a, &b), quantity),
                })
            }
            ("atan2", [y, x]) => {
                let (above, right) = (self.scalar(y, value_context), self.scalar(x, value_context));
                let ((above, of_y), (right, of_x)) = (above?, right?);
                let Some(_) = of_y.unify(of_x) else {
                    let message = format!(
                        "the arguments of `atan2` have one dimension: the first is {}, this is {}",
                        of_y.dimension().describe(),
                        of_x.dimension().describe()
                    );
                    let help = self.swallowed(x, of_x.dimension(), of_y.dimension());
                    return self.refuse_with(x.extent, message, help);
                };
                Some(Typed::Scalar(simplify::atan2(above, right), plain()))
            }
            (_, [argument]) => self.elementary(name, argument, value_context),
            // The number of arguments has already been checked.
            _ => None,
        }
    }

    fn elementary(&mut self, name: &str, argument: &Value, value_context: ValueContext) -> Option<Typed> {
        let (expr, quantity) = self.scalar(argument, value_context)?;
        if name == "sqrt" {
            let half = self.in_range(quantity.dimension().power(1, 2), argument.extent)?;
            return Some(Typed::Scalar(simplify::call(Function::Sqrt, expr), half));
        }
        let what = format!("the argument of `{name}`");
        self.expect(quantity, Dimension::NONE, &what, argument)?;
        let result = match Function::named(name) {
            Some(function) => simplify::call(function, expr),
            // atan(x) = atan2(x, 1).
            None => simplify::atan2(expr, Expr::Number(1.0)),
        };
        Some(Typed::Scalar(result, plain()))
    }
}

/// Why a function cannot be used at this place.
fn refusal(name: &str, needs: Needs, value_context: ValueContext) -> Option<(String, Option<String>)> {
    let message = match (needs, value_context) {
        // Whether a rate can be an output depends on the coordinate.
        (Arguments, _)
        | (Rates, ValueContext::GeneralizedForce | ValueContext::Output)
        | (Solution, ValueContext::Output) => return None,
        (Places, context) if context.knows_places() => return None,
        (Rates, ValueContext::Tension) => {
            let message = "in a tension, `rate` is the rate of the distance of its two ends";
            let help = "write `rate` without parentheses".to_string();
            return Some((message.to_string(), Some(help)));
        }
        (_, ValueContext::Tension) => {
            format!("`{name}` cannot be used here: a tension depends on `length` and `rate` only")
        }
        (Rates, ValueContext::Energy) => {
            let message = "a potential energy depends on places, not on rates".to_string();
            let help = "a force that depends on rates is `generalized`".to_string();
            return Some((message, Some(help)));
        }
        (Rates, ValueContext::Equation) => {
            let message = "an equation ties places, not rates".to_string();
            let help = "the rates of coasting coordinates are tied by `coupling`".to_string();
            return Some((message, Some(help)));
        }
        (Rates, _) => {
            format!("`{name}` depends on the motion; only generalized forces may use it")
        }
        (Places, _) => format!(
            "`{name}` depends on the motion; only outputs, generalized forces, potentials and equations may use it"
        ),
        (Solution, _) => {
            format!("`{name}` is known only when the motion is; only outputs may use it")
        }
    };
    Some((message, None))
}

/// An angle or a plain number.
fn plain() -> Quantity {
    Quantity::Of(Dimension::NONE)
}

/// Whether a function has this name.
pub(super) fn is_function(name: &str) -> bool {
    SIGNATURES.iter().any(|(known, ..)| *known == name)
}

pub(super) fn count(parameters: usize) -> String {
    match parameters {
        0 => "no arguments".to_string(),
        1 => "1 argument".to_string(),
        more => format!("{more} arguments"),
    }
}
