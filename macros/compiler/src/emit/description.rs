//! Names, units and nominal values for the runtime.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use super::tolerance;
use crate::base::names::{flattened, written};
use crate::mechanics::{self, Damping, Functions, Role, Unknown, resolved_modes};
use crate::model::mechanism::{Line, Mechanism, Unit};
use crate::program::Program;

/// `const DESCRIPTION`.
pub(super) fn description(mechanism: &Mechanism, functions: &Functions, program: &Program) -> TokenStream {
    let name = mechanism.name.to_string();
    let coordinates = functions.unknowns.iter().map(|unknown| {
        let Unknown { name, unit, role } = unknown;
        let name = text(name);
        let role = match role {
            Role::Position(_) | Role::Harmonic(_) => quote!(Position),
            Role::Speed(_) => quote!(Speed),
            Role::PositionReaction => quote!(PositionReaction),
            Role::VelocityReaction => quote!(VelocityReaction),
        };
        quote! {
            ::eigentol::CoordinateInfo {
                name: ::eigentol::Shared::Static(#name),
                unit: ::eigentol::Unit { symbol: ::eigentol::Shared::Static(#unit), scale: 1.0 },
                role: ::eigentol::Role::#role,
            }
        }
    });
    let inputs = mechanism.inputs.iter().map(|input| {
        let (name, unit) = (text(&input.name), unit(&input.unit));
        let tolerance = tolerance::info(&input.tolerance);
        quote! { ::eigentol::InputInfo { name: ::eigentol::Shared::Static(#name), unit: #unit, tolerance: #tolerance } }
    });
    let design = mechanism.design.iter().map(|variable| {
        let (name, unit) = (text(&variable.name), unit(&variable.unit));
        let nominal = variable.nominal;
        let tolerance = tolerance::info(&variable.tolerance);
        quote! {
            ::eigentol::DesignInfo { name: ::eigentol::Shared::Static(#name), unit: #unit, nominal: #nominal, tolerance: #tolerance }
        }
    });
    let outputs = mechanism.outputs.iter().map(|output| {
        let (name, unit) = (text(&output.name), unit(&output.unit));
        quote! { ::eigentol::OutputInfo { name: ::eigentol::Shared::Static(#name), unit: #unit } }
    });
    let excitations = functions.excitations.iter().map(|excitation| {
        let mechanics::Excitation { name, kind, with, order } = excitation;
        let (name, order) = (text(name), text(order));
        quote! {
            ::eigentol::ExcitationInfo {
                name: ::eigentol::Shared::Static(#name),
                kind: ::eigentol::Shared::Static(#kind),
                with: #with,
                order: ::eigentol::Shared::Static(#order),
            }
        }
    });
    let symmetric = functions.properties.symmetric_stiffness;
    let free_directions = functions.free.count;
    let held = &functions.held;
    let correlations = mechanism.correlations.iter().map(|of| {
        let ([first, second], correlation) = (of.variables.map(|id| id.index()), of.correlation);
        quote! { ::eigentol::CorrelationInfo { variables: [#first, #second], correlation: #correlation } }
    });
    let rings = functions.rings.iter().map(|ring| {
        let mechanics::RingPlaces { name, members, coordinates, patterns, design } = ring;
        let name = text(name);
        quote! {
            ::eigentol::RingInfo {
                name: ::eigentol::Shared::Static(#name),
                members: #members,
                coordinates: ::eigentol::Shared::Static(&[#(#coordinates),*]),
                patterns: #patterns,
                design: ::eigentol::Shared::Static(&[#(#design),*]),
            }
        }
    });
    let spans = functions.spans.iter().map(|span| {
        let line = match span.line {
            Line::Timoshenko => quote!(Timoshenko),
            Line::Slender => quote!(Slender),
            Line::Bar => quote!(Bar),
        };
        let elements = &span.elements;
        let [first, last] = span.ends.each_ref().map(|end| {
            let motions = end.iter().map(|(place, factor)| quote!((#place, #factor)));
            quote!(::eigentol::Shared::Static(&[#(#motions),*]))
        });
        quote! {
            ::eigentol::SpanInfo {
                line: ::eigentol::LineKind::#line,
                elements: ::eigentol::Shared::Static(&[#(#elements),*]),
                ends: [#first, #last],
            }
        }
    });
    let harmonics = &functions.harmonics;
    let length = mechanism.length;
    let frequency = unit(&mechanism.frequency_unit());
    let resolved_modes = match resolved_modes(mechanism, functions) {
        Some(count) => quote!(::core::option::Option::Some(#count)),
        None => quote!(::core::option::Option::None),
    };
    let damping = match functions.properties.damping {
        Damping::Zero => quote!(Zero),
        Damping::Gyroscopic => quote!(Gyroscopic),
        Damping::General => quote!(General),
    };
    let kernels = program.kernels.iter().map(|kernel| {
        let (name, cost) = (kernel.name, kernel.cost);
        let (operations, functions) = (cost.operations, cost.functions);
        quote! {
            ::eigentol::KernelInfo { name: ::eigentol::Shared::Static(#name), operations: #operations, functions: #functions }
        }
    });
    quote! {
        const DESCRIPTION: ::eigentol::Description = ::eigentol::Description {
            name: ::eigentol::Shared::Static(#name),
            coordinates: ::eigentol::Shared::Static(&[#(#coordinates),*]),
            inputs: ::eigentol::Shared::Static(&[#(#inputs),*]),
            design: ::eigentol::Shared::Static(&[#(#design),*]),
            outputs: ::eigentol::Shared::Static(&[#(#outputs),*]),
            excitations: ::eigentol::Shared::Static(&[#(#excitations),*]),
            symmetric_stiffness: #symmetric,
            free_directions: #free_directions,
            correlations: ::eigentol::Shared::Static(&[#(#correlations),*]),
            held: ::eigentol::Shared::Static(&[#(#held),*]),
            rings: ::eigentol::Shared::Static(&[#(#rings),*]),
            spans: ::eigentol::Shared::Static(&[#(#spans),*]),
            harmonics: ::eigentol::Shared::Static(&[#(#harmonics),*]),
            length: #length,
            frequency: #frequency,
            resolved_modes: #resolved_modes,
            damping: ::eigentol::DampingKind::#damping,
            kernels: ::eigentol::Shared::Static(&[#(#kernels),*]),
        };
    }
}

/// A name, or a text with names, as people write them.
fn text(of: impl ToString) -> String {
    written(&of.to_string()).into_owned()
}

fn unit(unit: &Unit) -> TokenStream {
    let Unit { symbol, scale } = unit;
    quote! { ::eigentol::Unit { symbol: ::eigentol::Shared::Static(#symbol), scale: #scale } }
}

/// What rustc warns of at the declaration: an unread local variable for every input and design variable that nothing refers to, and
/// the use of a deprecated constant for everything that seems not to be meant. The usual attributes silence
/// both. The functions shadow constants of the same names, which `let` would otherwise match.
pub(super) fn warnings(mechanism: &Mechanism) -> TokenStream {
    let names: Vec<_> = mechanism.unused().collect();
    let doubts = mechanism.doubts();
    if names.is_empty() && doubts.is_empty() {
        return TokenStream::new();
    }
    let plain = |name: &Ident, span| Ident::new(&flattened(&name.to_string()), span);
    let hide = |name: &Ident| plain(name, Span::call_site());
    let hidden = names.iter().map(|name| hide(name));
    let names = names.iter().map(|name| plain(name, name.span()));
    let doubtful: Vec<_> = doubts.iter().map(|x| plain(&x.name, x.name.span())).collect();
    let constants = doubtful.iter().map(hide);
    let notes = doubts.iter().map(|x| text(format!("{}; {}", x.message, x.help)));
    let levels = ["allow", "warn", "deny", "forbid"];
    let is_level = |a: &&syn::Attribute| levels.iter().any(|level| a.path().is_ident(level));
    let levels = mechanism.attributes.iter().filter(is_level);
    let conditions = mechanism.attributes.iter().filter(|a| a.path().is_ident("cfg"));
    quote! {
        #(#conditions)*
        #(#levels)*
        const _: () = {
            #(#[allow(dead_code, non_snake_case)] fn #hidden() {})*
            #(#[allow(non_snake_case)] let #names = 0;)*
            #(#[allow(non_upper_case_globals)] #[deprecated(note = #notes)] const #constants: () = ();)*
            #(let _ = #doubtful;)*
        };
    }
}
