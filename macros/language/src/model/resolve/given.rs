//! Values and tolerances given on their own, outside a declaration: for example an operating point on a command line or
//! in a file, in the units and words of the language.

use proc_macro2::TokenStream;
use quote::quote;

use super::expected::Expected;
use super::resolver::Resolver;
use super::scope::Scope;
use super::{items, resolver};
use crate::base::diagnostics::{Diagnostic, Diagnostics};
use crate::model::mechanism::Tolerance;
use crate::model::rules::physical;
use crate::syntax::ast::{Ast, Item, ItemKind, Limits, Unit};
use crate::syntax::parse::parse;
use crate::syntax::print;

/// The SI value of a quantity with this unit that is written as `text`: `3000 rpm`, `-2 * pi / 3`.
///
/// `what` names the quantity in messages.
///
/// ```
/// use eigentol_language::model::resolve::given;
///
/// let tokens = |text: &str| text.parse().unwrap();
/// let speed = given::value(tokens("60rpm"), tokens("rad/s"), "`speed`").unwrap();
/// assert!((speed - 2.0 * std::f64::consts::PI).abs() < 1e-12);
///
/// let error = given::value(tokens("3 m"), tokens("rpm"), "`speed`").unwrap_err();
/// assert!(error.to_string().contains("`speed` must be an angular speed (rpm), this is a length (m)"), "{error}");
/// let error = given::value(tokens("nan rpm"), tokens("rpm"), "`speed`").unwrap_err();
/// assert!(error.to_string().contains("unexpected `rpm`"), "{error}");
/// let error = given::value(tokens(""), tokens("rpm"), "`speed`").unwrap_err();
/// assert!(error.to_string().contains("found nothing"), "{error}");
/// ```
///
/// # Errors
/// The mistakes in the text.
pub fn value(text: TokenStream, unit: TokenStream, what: &str) -> Result<f64, Diagnostics> {
    let ast = read(quote!(mechanism Given { input given: #unit; design value = #text; }))?;
    let [of, given] = &ast.items[..] else {
        return not_one(&ast);
    };
    let (ItemKind::Input(input), ItemKind::Design(design)) = (&of.kind, &given.kind) else {
        return not_one(&ast);
    };
    if design.tolerance.is_some() {
        let mut mistakes = Diagnostics::new();
        mistakes.error(&design.name, "a value is expected here, without a tolerance");
        return Err(mistakes);
    }
    resolved(&ast, |resolver| {
        let expected = resolver.expected_in(&input.unit)?;
        let (number, quantity) = resolver.plain_number(&design.nominal)?;
        resolver.expect(quantity, expected, what, &design.nominal)?;
        Some(number)
    })
}

/// The tolerance of a quantity with this unit that is written as `text`: `3%`, `0.1 mm uniform`, `+0.2 -0.1 mm`, with
/// or without the sign `+/-` of a half-width, or `one of [1.9, 2.1] mm`. Limits are SI, or fractions of the value,
/// which is `nominal`, SI.
///
/// ```
/// use eigentol_language::model::resolve::given;
///
/// let tokens = |text: &str| text.parse().unwrap();
/// let tolerance = given::tolerance(tokens("3% uniform"), tokens("mm"), 0.02).unwrap();
/// assert_eq!((tolerance.lower, tolerance.upper, tolerance.relative), (-0.03, 0.03, true));
/// assert_eq!(given::tolerance(tokens("+0.2 0 mm"), tokens("m"), 0.02).unwrap().upper, 2e-4);
/// let error = given::tolerance(tokens("3 kg"), tokens("mm"), 0.02).unwrap_err();
/// assert!(error.to_string().contains("must be a length (mm), this is a mass (kg)"), "{error}");
/// ```
///
/// # Errors
/// The mistakes in the text.
pub fn tolerance(text: TokenStream, unit: TokenStream, nominal: f64) -> Result<Tolerance, Diagnostics> {
    read_tolerance(text, unit, nominal, false)
}

/// The tolerance that is written as `text`, for a design variable of a declaration without mistakes whose design
/// variables have these values, SI. It is checked like a declared one: its ends must be possible.
///
/// ```
/// use eigentol_language::model::resolve::given;
/// use eigentol_language::syntax::parse::parse;
///
/// let text = "mechanism A { design l = 1 m; gravity 9.81 m/s^2 along -z;
///     body bar: rod(mass: 1 kg, length: l, along: -z); joint t: revolute(y) from ground to bar; }";
/// let ast = parse(text.parse().unwrap()).unwrap();
/// let tolerance = |text: &str| given::design_tolerance(&ast, text.parse().unwrap(), 0, &[1.0]);
/// assert_eq!(tolerance("3%").unwrap().upper, 0.03);
/// let error = tolerance("300%").unwrap_err().to_string();
/// assert!(error.contains("within the tolerance of `l`, the length of `bar` is -2 m"), "{error}");
/// ```
///
/// # Errors
/// The mistakes in the text.
pub fn design_tolerance(
    ast: &Ast,
    text: TokenStream,
    variable: usize,
    design: &[f64],
) -> Result<Tolerance, Diagnostics> {
    let mut resolver = resolver(ast);
    let items = items(&mut resolver);
    let unit = match &*items.design[variable].unit.symbol {
        "" => quote!(1),
        symbol => symbol.parse().expect("a unit that was read before"),
    };
    let nominal = design[variable];
    let tolerance = read_tolerance(text, unit, nominal, true)?;
    let scale = if tolerance.relative { nominal.abs() } else { 1.0 };
    let mut points = resolver.design_points();
    for (point, value) in points.iter_mut().zip(design) {
        point.nominal = *value;
    }
    points[variable].limits = [scale * tolerance.lower, scale * tolerance.upper];
    points[variable].extent = Some((&ast.name).into());
    physical::check_given(
        &resolver.requirements,
        &resolver.constants,
        &points,
        variable,
        items.inputs.len(),
        &mut resolver.diagnostics,
    );
    resolver.diagnostics.into_result(tolerance)
}

fn read_tolerance(
    text: TokenStream,
    unit: TokenStream,
    nominal: f64,
    is_design: bool,
) -> Result<Tolerance, Diagnostics> {
    let half_width = !text.to_string().starts_with(['+', '-', 'o']);
    let sign = half_width.then(|| quote!(+/-));
    let ast = read(quote!(mechanism Given { input given: #unit #sign #text; }))?;
    let [Item { kind: ItemKind::Input(input), .. }] = &ast.items[..] else {
        return not_one(&ast);
    };
    resolved(&ast, |resolver| {
        let expected = resolver.expected_in(&input.unit)?;
        match &input.tolerance {
            // A quantity that is given by a list of values may get a new list.
            Some(tolerance) if matches!(tolerance.limits, Limits::Values(_)) => {
                resolver.design_tolerance(Some(tolerance), Some((nominal, expected)))
            }
            tolerance => {
                if is_design {
                    let nominal = Some((nominal, expected.clone()));
                    resolver.design_tolerance(tolerance.as_ref(), nominal)?;
                }
                resolver.input_tolerance(tolerance.as_ref(), Some(expected))
            }
        }
    })
}

/// Parses a declaration around a text, whose mistakes are told without the semicolon behind it.
fn read(declaration: TokenStream) -> Result<Ast, Diagnostics> {
    parse(declaration).map_err(|mistakes| {
        let mut diagnostics = Diagnostics::new();
        for mistake in mistakes.iter() {
            let message = match mistake.message.strip_prefix("expected `;`, found ") {
                Some(found) => format!("unexpected {found}"),
                None => mistake.message.replace(", found `;`", ", found nothing"),
            };
            diagnostics.push(Diagnostic { message, ..mistake.clone() });
        }
        diagnostics
    })
}

/// Rejects a text in which a semicolon has started another item.
fn not_one<T>(ast: &Ast) -> Result<T, Diagnostics> {
    let mut mistakes = Diagnostics::new();
    mistakes.error(&ast.name, "one value is expected here");
    Err(mistakes)
}

/// The result of a resolution step, or its mistakes.
fn resolved<T>(ast: &Ast, step: impl FnOnce(&mut Resolver<'_>) -> Option<T>) -> Result<T, Diagnostics> {
    let mut mistakes = Diagnostics::new();
    let scope = Scope::new(ast, &[], &mut mistakes);
    let mut resolver = Resolver::new(ast, Vec::new(), scope, mistakes);
    let outcome = step(&mut resolver);
    let mut mistakes = resolver.diagnostics;
    match outcome {
        Some(resolved_value) => mistakes.into_result(resolved_value),
        None => {
            if mistakes.is_empty() {
                mistakes.error(&ast.name, "this is not a value");
            }
            Err(mistakes)
        }
    }
}

impl Resolver<'_> {
    /// The quantity expected for this unit, in the words of its declaration.
    fn expected_in(&mut self, unit: &Unit) -> Option<Expected> {
        let (dimension, _) = self.unit(unit)?;
        Some(Expected::in_unit(dimension, &print::unit(unit)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> TokenStream {
        text.parse().unwrap()
    }

    fn message(outcome: Result<impl Sized, Diagnostics>) -> String {
        let mistakes = outcome.err().expect("a mistake");
        mistakes.iter().next().expect("a message").text()
    }

    #[test]
    fn values() {
        for (text, unit, si) in [
            ("3 mm", "m", 3e-3),
            ("-3mm", "m", -3e-3),
            ("0", "rpm", 0.0),
            ("pi / 2", "rad", std::f64::consts::FRAC_PI_2),
            ("2.5", "1", 2.5),
            ("3 kg * 2 m/s^2", "N", 6.0),
        ] {
            let parsed = value(tokens(text), tokens(unit), "it").unwrap();
            assert!((parsed - si).abs() <= 1e-15 * si.abs(), "{text}: {parsed}");
        }
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for (text, expected) in [
            ("3000", "`3000` has no unit; an angular speed is expected, for example `3000 rpm`"),
            ("3 rmp", "unknown unit `rmp`\nhelp: did you mean `rpm`?"),
            ("3 m", "`speed` must be"),
            ("3 rpm; design other = 4 rpm", "one value"),
            ("3 rpm +/- 3%", "without a tolerance"),
            ("", "expected a value"),
            ("omega", "unknown name `omega`"),
        ] {
            let refusal = message(value(tokens(text), tokens("rpm"), "`speed`"));
            assert!(refusal.contains(expected), "{text}: {refusal}");
        }
    }

    #[test]
    fn tolerances() {
        use crate::model::mechanism::Law;

        let symmetric = tolerance(tokens("0.1mm"), tokens("m"), 1.0).unwrap();
        assert_eq!((symmetric.lower, symmetric.upper, symmetric.relative), (-1e-4, 1e-4, false));
        let uniform = tolerance(tokens("+2% -1% uniform"), tokens("m"), 1.0).unwrap();
        assert_eq!((uniform.lower, uniform.upper, uniform.relative), (-0.01, 0.02, true));
        assert_eq!(uniform.law, Law::Uniform);
        let beta = tolerance(tokens("+/- 1 deg beta(2, 3)"), tokens("rad"), 1.0);
        assert!(matches!(beta.unwrap().law, Law::Beta { .. }));
        let discrete = tolerance(tokens("one of [20, 25, 22] mm weighted [1, 3, 1]"), tokens("mm"), 0.021).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-15;
        assert!(near(discrete.lower, -1e-3) && near(discrete.upper, 4e-3));
        let Law::OneOf(values) = discrete.law else { panic!("a list of values") };
        assert!(values[1] == (1.0, 3.0) && values[0] == (0.0, 1.0));
        assert!(near(values[2].0, 0.4) && values[2].1 == 1.0);
    }

    #[test]
    fn what_is_no_tolerance_is_refused() {
        for (text, expected) in [
            ("3 kg", "this tolerance must be a length (mm)"),
            ("3", "`3` has no unit; a length is expected, for example `3 mm`\nhelp: or in per cent: `3%`"),
            ("+3 -2", "for example `-2 mm`\nhelp: or in per cent: `-2%`"),
            ("-3%", "expected"),
            ("3% unifrom", "did you mean `uniform`?"),
            ("", "expected a value"),
        ] {
            let refusal = message(tolerance(tokens(text), tokens("mm"), 1.0));
            assert!(refusal.contains(expected), "{text}: {refusal}");
        }
    }
}
