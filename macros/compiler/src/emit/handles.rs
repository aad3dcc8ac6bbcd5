//! Handles for the user's code: a constant for each name of the declaration, spelled as declared and with its span, so
//! that editors can complete it and jump to it. What is in an instance or an array is reached as it is written:
//! `Rotor::blade[1].flap`.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use super::tolerance;
use crate::base::names::LINK;
use crate::mechanics::{Functions, Role};
use crate::model::mechanism::{Mechanism, Unit};

/// A handle, or those of an instance or an array by the next word of their names.
enum Handle {
    One { kind: Ident, index: usize, doc: String },
    Several(Vec<(String, Span, Handle)>),
}

/// The handles of a mechanism; those that are not alone need types of their own.
struct Handles {
    all: Vec<(String, Span, Handle)>,
}

/// The constants of the single names, and what belongs to those of instances and arrays: types and constants.
pub(super) fn handles(mechanism: &Mechanism, functions: &Functions) -> [TokenStream; 2] {
    let mut handles = Handles { all: Vec::new() };
    for (index, unknown) in functions.unknowns.iter().enumerate() {
        let (id, kind) = match unknown.role {
            Role::Position(id) => (id, "Free coordinate"),
            Role::Speed(id) => (id, "Speed of a coasting coordinate"),
            Role::Harmonic(_) | Role::PositionReaction | Role::VelocityReaction => continue,
        };
        let name = Ident::new(&unknown.name, mechanism.coordinates[id.index()].name.span());
        let doc = format!("{kind}, {}.", unknown.unit);
        handles.add(&name, "Coordinate", index, doc);
    }
    for (index, input) in mechanism.inputs.iter().enumerate() {
        let unit = shown(&input.unit);
        let tolerance = tolerance::doc(&input.tolerance, unit, input.unit.scale);
        let doc = with_docs(&input.docs, format!("Input, declared in {unit}{tolerance}."));
        handles.add(&input.name, "Input", index, doc);
    }
    for (index, variable) in mechanism.design.iter().enumerate() {
        let (unit, scale) = (shown(&variable.unit), variable.unit.scale);
        let nominal = variable.nominal / scale;
        let tolerance = tolerance::doc(&variable.tolerance, unit, scale);
        let text = format!("Design variable, nominally {nominal} {unit}{tolerance}.");
        let doc = with_docs(&variable.docs, text);
        handles.add(&variable.name, "DesignVariable", index, doc);
    }
    for (index, output) in mechanism.outputs.iter().enumerate() {
        let doc = with_docs(&output.docs, format!("Output, {}.", shown(&output.unit)));
        handles.add(&output.name, "Output", index, doc);
    }
    let excitations = mechanism.excitations.iter().zip(&functions.excitations);
    for (index, (excitation, facts)) in excitations.enumerate() {
        let doc = match facts.order.as_str() {
            "" => format!("Excitation: {}.", facts.kind),
            order => format!("Excitation: {}, order {order}.", facts.kind),
        };
        handles.add(&excitation.name, "Excitation", index, doc);
    }
    handles.emit(mechanism)
}

impl Handles {
    fn add(&mut self, name: &Ident, kind: &str, index: usize, doc: String) {
        let handle = Handle::One { kind: Ident::new(kind, Span::call_site()), index, doc };
        let text = name.to_string();
        insert(&mut self.all, &text.split(LINK).collect::<Vec<_>>(), name.span(), handle);
    }

    fn emit(self, mechanism: &Mechanism) -> [TokenStream; 2] {
        let Mechanism { name: of, visibility, .. } = mechanism;
        let mut types = Types { of, known: BTreeMap::new(), items: TokenStream::new() };
        let (mut single, mut grouped) = (TokenStream::new(), TokenStream::new());
        for (name, span, handle) in &self.all {
            let (list, doc) = match handle {
                Handle::One { doc, .. } => (&mut single, doc.as_str()),
                Handle::Several(_) => (&mut grouped, "Handles of an instance or an array."),
            };
            let name = Ident::new(name, *span);
            let (kind, value) = match handle {
                Handle::One { kind, index, .. } => {
                    (quote! { ::eigentol::#kind<Self> }, quote! { ::eigentol::#kind::new(#index) })
                }
                Handle::Several(_) => types.emit(handle),
            };
            list.extend(quote_spanned! { *span => #[doc = #doc] #visibility const #name: #kind = #value; });
        }
        let items = types.items;
        if !grouped.is_empty() {
            grouped = quote! {
                #items
                #[allow(non_upper_case_globals, dead_code)]
                impl #of { #grouped }
            };
        }
        [single, grouped]
    }
}

/// Adds a handle under the words of its name.
fn insert(all: &mut Vec<(String, Span, Handle)>, words: &[&str], span: Span, handle: Handle) {
    let [first, rest @ ..] = words else { return };
    if rest.is_empty() {
        all.push(((*first).to_owned(), span, handle));
        return;
    }
    let place = all.iter().position(|(name, _, of)| name == first && matches!(of, Handle::Several(_)));
    let place = place.unwrap_or_else(|| {
        all.push(((*first).to_owned(), span, Handle::Several(Vec::new())));
        all.len() - 1
    });
    if let Handle::Several(inside) = &mut all[place].2 {
        insert(inside, rest, span, handle);
    }
}

/// The types of instances; two with the same names in them are of the same type.
struct Types<'a> {
    of: &'a Ident,
    known: BTreeMap<String, Ident>,
    items: TokenStream,
}

impl Types<'_> {
    /// The type and the value of a handle.
    fn emit(&mut self, handle: &Handle) -> (TokenStream, TokenStream) {
        let of = self.of;
        let inside = match handle {
            Handle::One { kind, index, .. } => {
                return (quote! { ::eigentol::#kind<#of> }, quote! { ::eigentol::#kind::new(#index) });
            }
            Handle::Several(inside) => inside,
        };
        let (kinds, values): (Vec<_>, Vec<_>) = inside.iter().map(|(.., handle)| self.emit(handle)).unzip();
        let texts: Vec<String> = kinds.iter().map(ToString::to_string).collect();
        let in_order = inside.iter().enumerate().all(|(k, (name, ..))| *name == k.to_string());
        if in_order && texts.iter().all(|text| *text == texts[0]) {
            let (kind, count) = (&kinds[0], kinds.len());
            return (quote! { [#kind; #count] }, quote! { [#(#values),*] });
        }
        let field = |(name, span, _): &(String, Span, Handle)| {
            let is_number = name.starts_with(|c: char| c.is_ascii_digit());
            Ident::new(&if is_number { format!("_{name}") } else { name.clone() }, *span)
        };
        let fields: Vec<Ident> = inside.iter().map(field).collect();
        let key: Vec<String> = fields.iter().zip(&texts).map(|(name, text)| format!("{name}: {text}")).collect();
        let number = self.known.len();
        let mut is_new = false;
        let name = self.known.entry(key.join(", ")).or_insert_with(|| {
            is_new = true;
            Ident::new(&format!("{of}Names{number}"), Span::call_site())
        });
        if is_new {
            let docs = inside.iter().map(|(.., handle)| match handle {
                Handle::One { doc, .. } => doc.as_str(),
                Handle::Several(_) => "Handles of an instance or an array.",
            });
            self.items.extend(quote! {
                /// Handles of an instance.
                #[derive(Clone, Copy, Debug)]
                #[allow(dead_code, non_snake_case, unreachable_pub)]
                pub struct #name { #(#[doc = #docs] pub #fields: #kinds,)* }
            });
        }
        (quote! { #name }, quote! { #name { #(#fields: #values),* } })
    }
}

fn with_docs(docs: &[String], facts: String) -> String {
    match docs {
        [] => facts,
        docs => format!("{}\n\n{facts}", docs.join("\n").trim()),
    }
}

fn shown(unit: &Unit) -> &str {
    if unit.symbol.is_empty() { "1" } else { &unit.symbol }
}
