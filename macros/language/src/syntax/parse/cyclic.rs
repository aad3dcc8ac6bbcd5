//! Equal instances around an axis: written out like a loop, each turned further, and marked as a ring.

use proc_macro2::{Delimiter, Ident};

use super::super::ast::{Cyclic, ItemKind, Unit, UnitFactor, Value, ValueKind};
use super::super::scope::{Scope, Turned};
use super::super::tokens::{Parsed, Tokens, mistake};
use super::repeat::range;
use super::value::value;
use super::{Read, parts};
use crate::base::diagnostics::Diagnostic;
use crate::base::names::joined;

const CYCLIC: &str = "write `cyclic blade[0..4] about z { use blade: Blade(..) with root: hub; }`";

/// Reads `cyclic blade[0..N] about z { use blade: ...; }`, or `cyclic blade[0..N] about z;` of instances that are declared
/// by themselves.
pub(super) fn cyclic(tokens: &mut Tokens<'_>, read: &mut Read<'_>) -> Parsed<()> {
    let help = |error: Box<Diagnostic>| match error.help {
        Some(_) => error,
        None => Box::new(error.with_help(CYCLIC)),
    };
    tokens.expect_word("cyclic")?;
    let name = tokens.name("the name of the instances").map_err(help)?;
    let whole = Ident::new(&tokens.scope.whole(&name.to_string()), name.span());
    let Some((_, mut indices, _)) = tokens.group(Delimiter::Bracket) else {
        return tokens.expected("a range such as `[0..4]`").map_err(help);
    };
    let members = range(&mut indices).map_err(help)?;
    if !indices.is_empty() {
        return indices.expected("`]`").map_err(help);
    }
    if members.len() < 2 {
        let message = format!("a ring has two instances or more, and this one has {}", members.len());
        return mistake(&name, message);
    }
    tokens.expect_word("about").map_err(help)?;
    let about = value(tokens)?;
    if tokens.sign(';').is_none() {
        let Some((_, content, _)) = tokens.group(Delimiter::Brace) else {
            return tokens.expected("`{` or `;`").map_err(help);
        };
        tokens.scope.spend(members.len(), &name)?;
        for (place, index) in members.clone().enumerate() {
            let mut scope: Scope<'_> = tokens.scope.clone();
            let turn = 360.0 * place as f64 / members.len() as f64;
            let factors = vec![UnitFactor { name: "deg".to_owned(), extent: about.extent, exponent: 1 }];
            let degrees = Unit { factors, extent: about.extent };
            let angle = Value::new(ValueKind::Number(turn, Some(degrees)), about.extent);
            let ring = whole.to_string();
            let instance = joined(&ring, &index.to_string());
            scope.turned = Some(Turned { ring, instance, rotation: (about.clone(), angle) });
            let mut content = content.within(&scope);
            while !content.is_empty() {
                if content.sign(';').is_some() {
                    continue;
                }
                if !content.peek_word("use") {
                    let error = content.expected::<()>("`use`: what stands around an axis is an instance of a part");
                    return error.map_err(help);
                }
                parts::use_part(&mut content, read)?;
            }
        }
    }
    read.add(Vec::new(), ItemKind::Cyclic(Cyclic { name: whole, members, about }));
    Ok(())
}
