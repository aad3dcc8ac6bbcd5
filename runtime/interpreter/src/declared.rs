//! A declaration as text, with the values and tolerances that were found.

use std::collections::BTreeMap;
use std::ops::Range;

use eigentol::{Description, Text};
use eigentol_compiler::syntax::ast::{Ast, ItemKind};
use eigentol_compiler::syntax::print::{tolerance, unit, value};
use proc_macro2::Ident;

use crate::names::meant;

/// What is declared of an input or a design variable.
struct Variable<'a> {
    name: String,
    token: &'a Ident,
    /// What stands before its tolerance: the unit of an input, the value of a design variable.
    before: String,
    /// As it is written after that, or nothing.
    tolerance: String,
}

/// Inputs, then design variables.
fn variables<'a>(of: &'a Ast, d: &Description) -> Vec<Variable<'a>> {
    let items = || of.items.iter();
    let inputs = items().filter_map(|item| match &item.kind {
        ItemKind::Input(own) => Some((&own.name, unit(&own.unit), own.tolerance.as_ref())),
        _ => None,
    });
    let design = items().filter_map(|item| match &item.kind {
        ItemKind::Design(own) => Some((&own.name, value(&own.nominal), own.tolerance.as_ref())),
        _ => None,
    });
    let names = d.inputs.iter().map(|info| &info.name).chain(d.design.iter().map(|info| &info.name));
    let all = names.zip(inputs.chain(design));
    let variable = |(name, (token, before, declared)): (&Text, (_, String, _))| Variable {
        name: name.to_string(),
        token,
        before,
        tolerance: tolerance(declared).trim_start().to_owned(),
    };
    all.map(variable).collect()
}

/// The declared tolerances of the inputs and design variables that have one, by name: `+/- 1 mm uniform`.
pub fn declared_tolerances(of: &Ast, d: &Description) -> BTreeMap<String, String> {
    let all = variables(of, d).into_iter().map(|own| (own.name, own.tolerance));
    all.filter(|(_, text)| !text.is_empty()).collect()
}

/// The text of a declaration in which design variables have other values, and they and inputs other tolerances, each given as
/// in [`with_setting`](crate::with_setting) by name or pattern; with the names of those that it cannot say, because they share a line
/// with others that differ.
///
/// ```
/// use eigentol::Mechanism as _;
/// use eigentol_compiler::{compile_text, mechanics::Limits};
/// use eigentol_interpreter::{Interpreted, rewritten};
///
/// let text = "mechanism A {
///     design k = 9 N/m; // of the spring
///     body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a; force s: spring(on: x, stiffness: k);
/// }";
/// let compilation = compile_text(text, Limits::default())?;
/// let machine = Interpreted::new(&compilation);
/// let values = [("k".to_owned(), "4 N/m".to_owned())].into();
/// let tolerances = [("k".to_owned(), "5% uniform".to_owned())].into();
/// let (new, unsaid) = rewritten(text, &compilation.ast, machine.description(), &values, &tolerances);
/// assert!(new.contains("design k = 4 N/m +/- 5% uniform; // of the spring"));
/// assert!(unsaid.is_empty());
/// # Ok::<(), eigentol_interpreter::Mistakes>(())
/// ```
pub fn rewritten(
    text: &str,
    of: &Ast,
    d: &Description,
    values: &BTreeMap<String, String>,
    tolerances: &BTreeMap<String, String>,
) -> (String, Vec<String>) {
    let values = by_name(values, d);
    let tolerances = by_name(tolerances, d);
    let mut places: BTreeMap<usize, Vec<Line>> = BTreeMap::new();
    let mut unsaid = Vec::new();
    for (k, own) in variables(of, d).into_iter().enumerate() {
        let is_input = k < d.inputs.len();
        let (value, spread) = (values.get(&own.name).filter(|_| !is_input), tolerances.get(&own.name));
        let changed = value.is_some() || spread.is_some();
        let Some((range, old)) = stated(text, own.token, if is_input { ':' } else { '=' }) else {
            unsaid.extend(changed.then_some(own.name));
            continue;
        };
        let new = if changed {
            let value = value.map_or(&*own.before, |value| value.trim());
            let spread = spread.map_or(own.tolerance, |text| with_sign(text));
            format!("{value} {spread}").trim_end().to_owned()
        } else {
            old.to_owned()
        };
        places.entry(range.start).or_default().push(Line { name: own.name, range, new, changed });
    }
    let mut whole = text.to_owned();
    for lines in places.into_values().rev() {
        if lines.iter().all(|line| line.new == lines[0].new) {
            whole.replace_range(lines[0].range.clone(), &lines[0].new);
        } else {
            unsaid.extend(lines.into_iter().filter(|line| line.changed).map(|line| line.name));
        }
    }
    (whole, unsaid)
}

/// What a declaration says of one variable, and where.
struct Line {
    name: String,
    range: Range<usize>,
    new: String,
    changed: bool,
}

fn by_name(given: &BTreeMap<String, String>, d: &Description) -> BTreeMap<String, String> {
    let each = given.iter().flat_map(|(pattern, text)| meant(pattern, d).into_iter().map(move |name| (name, text)));
    each.map(|(name, text)| (name, text.clone())).collect()
}

/// A tolerance as it stands in a declaration.
fn with_sign(text: &str) -> String {
    let text = text.trim();
    if text.starts_with(['+', '-']) || text.starts_with("one of") { text.to_owned() } else { format!("+/- {text}") }
}

/// What stands between the mark behind a name and the end of its item.
fn stated<'a>(text: &'a str, name: &Ident, mark: char) -> Option<(Range<usize>, &'a str)> {
    let end = name.span().end();
    let line: usize = text.split_inclusive('\n').take(end.line.checked_sub(1)?).map(str::len).sum();
    let own = text.get(line..)?;
    let name = line + own.char_indices().nth(end.column).map_or(own.len(), |(at, _)| at);
    let after = text.get(name..)?;
    let close = after.find(';')?;
    let open = after[..close].find(mark)? + 1;
    let open = open + after[open..close].len() - after[open..close].trim_start().len();
    Some((name + open..name + close, &after[open..close]))
}
