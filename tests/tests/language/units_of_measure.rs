//! A mechanism has no idea of metres: written in other units of length, mass and time, every machine moves alike.
//!
//! Each number with a unit in a declaration is multiplied by a power of two for each of its dimensions, which gives the
//! similar machine of another size, density and pace: a watch, a micromachine, a crane. Its results, divided by the
//! same powers, are those of the original up to rounding. Whatever compares numbers of different units fails here.

use eigentol::{Coordinate, Error, Input, Policy, Study, Unit};
use eigentol_interpreter::Interpreted;
use eigentol_tests::rederived::{Operation, operating_points};
use eigentol_tests::tables;
use proc_macro2::{Delimiter, Group, Literal, TokenStream, TokenTree};

/// Units of length, mass and time of the similar machine, as powers of two.
type Scale = [i32; 3];

/// Exponents of length, mass and time of the units that the declarations use.
const UNITS: [(&str, [i32; 3]); 28] = [
    ("m", [1, 0, 0]),
    ("cm", [1, 0, 0]),
    ("mm", [1, 0, 0]),
    ("um", [1, 0, 0]),
    ("inch", [1, 0, 0]),
    ("ft", [1, 0, 0]),
    ("kg", [0, 1, 0]),
    ("g", [0, 1, 0]),
    ("t", [0, 1, 0]),
    ("lb", [0, 1, 0]),
    ("s", [0, 0, 1]),
    ("ms", [0, 0, 1]),
    ("min", [0, 0, 1]),
    ("N", [1, 1, -2]),
    ("mN", [1, 1, -2]),
    ("kN", [1, 1, -2]),
    ("MN", [1, 1, -2]),
    ("Pa", [-1, 1, -2]),
    ("MPa", [-1, 1, -2]),
    ("GPa", [-1, 1, -2]),
    ("J", [2, 1, -2]),
    ("W", [2, 1, -3]),
    ("Hz", [0, 0, -1]),
    ("rpm", [0, 0, -1]),
    ("rad", [0; 3]),
    ("mrad", [0; 3]),
    ("deg", [0; 3]),
    ("rev", [0; 3]),
];

/// Whether the token at this place is this sign.
fn is(tokens: &[TokenTree], at: usize, sign: char) -> bool {
    matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

/// The dimension of a unit at the start of these tokens, and how many tokens it takes; none if there is no unit.
fn unit(tokens: &[TokenTree]) -> ([i32; 3], usize) {
    let (mut dimension, mut taken, mut sign) = ([0; 3], 0, 1);
    loop {
        let start = if taken == 0 { 0 } else { taken + 1 };
        let Some(TokenTree::Ident(name)) = tokens.get(start) else {
            break;
        };
        let Some((_, own)) = UNITS.iter().find(|(known, _)| name == known) else {
            break;
        };
        let mut end = start + 1;
        let mut power = 1;
        if is(tokens, end, '^')
            && let Some(TokenTree::Literal(exponent)) = tokens.get(end + 1)
        {
            power = exponent.to_string().parse().expect("a whole exponent");
            end += 2;
        }
        for (sum, own) in dimension.iter_mut().zip(own) {
            *sum += sign * power * own;
        }
        taken = end;
        sign = match () {
            () if is(tokens, taken, '*') => 1,
            () if is(tokens, taken, '/') => -1,
            () => break,
        };
    }
    (dimension, taken)
}

/// What a quantity of this dimension is multiplied by.
fn factor(scale: Scale, dimension: [i32; 3]) -> f64 {
    let exponents = scale.iter().zip(dimension);
    2f64.powi(exponents.map(|(scale, power)| scale * power).sum())
}

fn factor_of(scale: Scale, symbol: &Unit) -> f64 {
    let tokens: Vec<TokenTree> = symbol.symbol.parse::<TokenStream>().expect("a unit").into_iter().collect();
    // `1/s` has no unit above the line.
    let (sign, tokens) = match &tokens[..] {
        [TokenTree::Literal(_), _, rest @ ..] => (-1, rest),
        all => (1, all),
    };
    let (dimension, taken) = unit(tokens);
    assert_eq!(taken, tokens.len(), "{}", symbol.symbol);
    factor(scale, dimension.map(|power| sign * power))
}

/// The declaration of the similar machine. Numbers without a unit of their own are multiplied by `outer`, that of the
/// list they are in.
fn rescaled(tokens: TokenStream, scale: Scale, outer: f64) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        let (dimension, taken) = unit(&tokens[k + 1..]);
        let own = if taken > 0 { factor(scale, dimension) } else { outer };
        let exponent = k > 0 && is(&tokens, k - 1, '^');
        found.push(match token {
            TokenTree::Literal(number) if !exponent => {
                let word = match tokens.get(k + 1) {
                    Some(TokenTree::Ident(word)) => Some(word.to_string()),
                    _ => None,
                };
                // An order is so many turns `of` a drive, a station so many times the `length` of a beam.
                let knows = |word: &str| ["of", "length"].contains(&word);
                let unknown = word.is_some_and(|word| !knows(&word)) && taken == 0;
                assert!(!unknown, "an unknown unit: {number} {}", tokens[k + 1]);
                match number.to_string().replace('_', "").parse::<f64>() {
                    Ok(value) if own != 1.0 => Literal::f64_unsuffixed(value * own).into(),
                    _ => token.clone(),
                }
            }
            TokenTree::Group(group) => {
                let list = group.delimiter() == Delimiter::Bracket;
                let inside = rescaled(group.stream(), scale, if list { own } else { 1.0 });
                Group::new(group.delimiter(), inside).into()
            }
            _ => token.clone(),
        });
    }
    found.into_iter().collect()
}

/// A similar machine in use.
struct Similar {
    study: Study<Interpreted>,
    scale: Scale,
}

/// Names with values that are rounded alike.
type Results = Vec<(String, Vec<f64>)>;

fn words(error: Error) -> String {
    error.to_string()
}

impl Similar {
    fn new(declaration: &str, operation: &Operation, scale: Scale) -> Result<Self, String> {
        let tokens = declaration.parse().expect("tokens");
        let text = rescaled(tokens, scale, 1.0).to_string();
        let machine = Interpreted::from_text(&text).map_err(|error| error.to_string())?;
        let mut study = Study::new(machine).policy(operation.policy);
        let description = study.description().clone();
        let inputs = operation.inputs.iter().zip(description.inputs.iter());
        for (k, (value, info)) in inputs.enumerate() {
            study = study.input(Input::new(k), value * factor_of(scale, &info.unit));
        }
        let start = operation.start.iter().zip(description.coordinates.iter());
        for (k, (value, info)) in start.enumerate() {
            study = study.guess(Coordinate::new(k), value * factor_of(scale, &info.unit));
        }
        Ok(Self { study, scale })
    }

    fn unit(&self, unit: &Unit) -> f64 {
        factor_of(self.scale, unit)
    }

    fn time(&self) -> f64 {
        factor(self.scale, [0, 0, 1])
    }

    /// Equilibrium, modes, outputs and their derivatives, in the units of the original machine.
    fn at_point(&self) -> Result<Results, String> {
        let equilibrium = self.study.equilibrium().map_err(words)?;
        let (state, description) = (&equilibrium, self.study.description());
        let mut results = vec![(format!("{:?}", state.stability), vec![])];
        let coordinates = state.coordinates.iter().zip(description.coordinates.iter());
        for (value, info) in coordinates {
            results.push((format!("at {}", info.name), vec![value / self.unit(&info.unit)]));
        }
        let units = description.design.iter().map(|info| self.unit(&info.unit));
        let units: Vec<f64> = units.collect();
        results.extend(self.modes(&units)?);
        let outputs = self.study.outputs().map_err(words)?;
        for (o, info) in description.outputs.iter().enumerate() {
            let own = self.unit(&info.unit);
            results.push((info.name.to_string(), vec![outputs.values[o] / own]));
            if let Some(slopes) = &outputs.by_design[o] {
                let slopes = slopes.iter().zip(&units);
                let slopes = slopes.map(|(slope, unit)| slope * unit / own);
                results.push((format!("slopes of {}", info.name), slopes.collect()));
            }
        }
        Ok(results)
    }

    fn modes(&self, units: &[f64]) -> Result<Results, String> {
        let (time, all) = (self.time(), self.study.modes().map_err(words)?.modes);
        let square = time * time;
        let slopes = self.study.sensitivities().map_err(words)?;
        let spreads = self.study.first_order().map_err(words)?;
        // Modes of one frequency come in either order.
        let key = |k: &usize| {
            let s = all[*k].s;
            [s.im * time, s.re * time].map(|value| (value * 1e6).round())
        };
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("finite"));
        let mut results = Results::new();
        for (position, mode) in order.into_iter().enumerate() {
            let (s, slope) = (all[mode].s, &slopes.modes[mode]);
            results.push((format!("mode {position}"), vec![s.re * time, s.im * time]));
            let by_design = slope.lambda.by_design.iter().zip(units);
            let by_design = by_design.map(|(slope, unit)| slope * square * unit);
            results.push((format!("slopes of mode {position}"), by_design.collect()));
            let sigma = spreads.modes[mode].lambda.sigma * square;
            results.push((format!("spread of mode {position}"), vec![sigma]));
            if slope.clustered {
                continue;
            }
            let curvature = self.study.mode_curvature(mode).map_err(words)?;
            let curvature = curvature.lambda.by_design;
            let entries = (0..units.len()).flat_map(|i| (0..units.len()).map(move |j| (i, j)));
            let curvature = entries.map(|(i, j)| curvature[i][j] * square * units[i] * units[j]);
            results.push((format!("curvatures of mode {position}"), curvature.collect()));
            self.study.shape_sensitivity(mode).map_err(words)?;
        }
        Ok(results)
    }

    /// Eigenvalues along the first input, if there is one, which starts at a share of its value.
    fn along(&self, operation: &Operation, from: f64) -> Result<Results, String> {
        let inputs = &self.study.description().inputs;
        let Some((value, info)) = operation.inputs.first().zip(inputs.first()) else {
            return Ok(Results::new());
        };
        let value = value * self.unit(&info.unit);
        let step = (1.1 - from) / f64::from(SWEPT - 1);
        let values = (0..SWEPT).map(|k| value * (from + step * f64::from(k)));
        let values: Vec<f64> = values.collect();
        let sweep = self.study.sweep(Input::new(0), &values).map_err(words)?;
        let each = sweep.points.iter().enumerate().map(|(k, point)| {
            let modes = point.modes.as_ref().map_err(|error| error.to_string())?;
            let sizes = modes.modes.iter().map(|mode| mode.s.norm() * self.time());
            let mut sizes: Vec<f64> = sizes.collect();
            sizes.sort_by(f64::total_cmp);
            Ok((format!("sweep {k}"), sizes))
        });
        each.collect()
    }
}

/// The results of the similar machine in the units of the original; a sweep starts at a share of its first input.
fn results(declaration: &str, operation: &Operation, scale: Scale, from: f64) -> Result<Results, String> {
    let machine = Similar::new(declaration, operation, scale)?;
    let mut results = machine.at_point()?;
    results.extend(machine.along(operation, from)?);
    Ok(results)
}

/// Similar machines: a watch, a micromachine, a crane; in a frantic and in a slow world; as light as a feather, as heavy
/// as a ship; one with nothing in proportion.
const SCALES: [Scale; 8] =
    [[-10, -30, -7], [-15, -45, -17], [3, 9, 2], [0, 0, -17], [0, 0, 10], [0, -40, 0], [0, 30, 0], [-12, 5, -9]];
/// Number of values in a sweep.
const SWEPT: i32 = 12;
/// Results agree to this share of the largest number of their kind.
const ROUNDING: f64 = 1e-8;
/// Numbers this small are zero, in the units of the original machine.
const NOTHING: f64 = 1e-3;

/// Machines with several stable equilibria. Which one is found from afar depends on the reach of a first step, one metre;
/// here they start at the one of the original.
const SEVERAL: [&str; 1] = ["slider_crank"];

/// Two of the scales for the machine of an index, all of them in turn for all machines.
fn two(index: usize) -> [Scale; 2] {
    [0, 3].map(|further| SCALES[(index + further) % SCALES.len()])
}

fn compare(name: &str, declaration: &str, operation: &Operation, scales: &[Scale]) {
    // Without start values an equilibrium is found from afar.
    let afar = operation.start.is_empty() && !SEVERAL.contains(&name);
    let from = if afar { 0.2 } else { 1.0 };
    let original = results(declaration, operation, [0; 3], from);
    let expected = original.unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut operation = operation.clone();
    if SEVERAL.contains(&name) {
        let unknowns = expected.iter().filter(|(what, _)| what.starts_with("at "));
        operation.start = unknowns.map(|(_, value)| value[0]).collect();
    }
    for &scale in scales {
        let found = results(declaration, &operation, scale, from);
        let found = found.unwrap_or_else(|error| panic!("{name} {scale:?}: {error}"));
        assert_eq!(found.len(), expected.len(), "{name} {scale:?}");
        for ((what, found), (same, expected)) in found.iter().zip(&expected) {
            assert_eq!(what, same, "{name} {scale:?}");
            let most = expected.iter().fold(NOTHING, |most, value| most.max(value.abs()));
            for (found, expected) in found.iter().zip(expected) {
                let close = (found - expected).abs() <= ROUNDING * most;
                assert!(close, "{name} {scale:?}, {what}: {found}, not {expected}");
            }
        }
    }
}

fn compare_open(scales: impl Fn(usize) -> Vec<Scale>) {
    for (index, machine) in tables::open().into_iter().enumerate() {
        for operation in operating_points(machine.name) {
            compare(machine.name, machine.declaration, &operation, &scales(index));
        }
    }
}

fn compare_constrained(scales: impl Fn(usize) -> Vec<Scale>) {
    for (index, machine) in tables::constrained().into_iter().enumerate() {
        let inputs = machine
            .kernels
            .description()
            .inputs
            .iter()
            .map(|info| {
                let plain = factor_of([1, 2, 3], &info.unit) == 1.0;
                if plain { 0.3 } else { 5.0 }
            })
            .collect();
        let operation = Operation { inputs, start: Vec::new(), policy: Policy::Stable };
        compare(machine.name, machine.declaration, &operation, &scales(index));
    }
}

#[test]
fn open_machines_do_not_know_their_units() {
    compare_open(|index| two(index).into());
}

#[test]
fn machines_with_constraints_do_not_know_their_units() {
    compare_constrained(|index| two(index).into());
}

#[test]
#[ignore = "ten seconds"]
fn no_machine_knows_its_units_at_any_scale() {
    compare_open(|_| SCALES.into());
    compare_constrained(|_| SCALES.into());
}

#[test]
fn declarations_are_rescaled() {
    let text = "design a = 3 kN/m^2 +/- 2%; let b = [[1, -2.5], [0, 4 m]] g*s; force(c * 2, 1_000 rpm)";
    let found = rescaled(text.parse().expect("tokens"), [3, 5, 7], 1.0).to_string();
    let force = 3.0 * 2f64.powi(3 + 5 - 14 - 6);
    let expected = format!(
        "design a = {force} kN/m^2 +/- 2%; let b = [[4096.0, -10240.0], [0.0, 32.0 m]] g*s; force(c * 2, 7.8125 rpm)"
    );
    let plain = |text: &str| text.split_whitespace().collect::<String>();
    assert_eq!(plain(&found), plain(&expected));
}
