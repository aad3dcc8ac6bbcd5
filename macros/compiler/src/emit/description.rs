//! Names, units and nominal values for the runtime, and handles for the user's code.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};

use crate::mechanics::{Damping, Properties};
use crate::model::mechanism::{CoordinateQuantity, Mechanism, Unit};
use crate::program::Program;
use crate::topology::Topology;

/// `const DESCRIPTION`.
pub(super) fn description(
    mechanism: &Mechanism,
    topology: &Topology,
    properties: Properties,
    program: &Program,
) -> TokenStream {
    let name = mechanism.name.to_string();
    let coordinates = topology.free.iter().map(|id| {
        let coordinate = &mechanism.coordinates[id.index()];
        let name = coordinate.name.to_string();
        let symbol = coordinate_unit(coordinate.quantity);
        quote! {
            ::eigentol::CoordinateInfo {
                name: #name,
                unit: ::eigentol::Unit { symbol: #symbol, scale: 1.0 },
                role: ::eigentol::Role::Position,
            }
        }
    });
    let inputs = mechanism.inputs.iter().map(|input| {
        let (name, unit) = (input.name.to_string(), unit(&input.unit));
        quote! { ::eigentol::InputInfo { name: #name, unit: #unit } }
    });
    let design = mechanism.design.iter().map(|variable| {
        let (name, unit) = (variable.name.to_string(), unit(&variable.unit));
        let (nominal, tolerance) = (variable.nominal, variable.tolerance);
        quote! {
            ::eigentol::DesignInfo { name: #name, unit: #unit, nominal: #nominal, tolerance: #tolerance }
        }
    });
    let outputs = mechanism.outputs.iter().map(|output| {
        let (name, unit) = (output.name.to_string(), unit(&output.unit));
        quote! { ::eigentol::OutputInfo { name: #name, unit: #unit } }
    });
    let symmetric = properties.symmetric_stiffness;
    let damping = match properties.damping {
        Damping::Zero => quote!(Zero),
        Damping::Gyroscopic => quote!(Gyroscopic),
        Damping::General => quote!(General),
    };
    let kernels = program.kernels.iter().map(|kernel| {
        let (name, cost) = (kernel.name, kernel.cost);
        let (operations, functions) = (cost.operations, cost.functions);
        quote! {
            ::eigentol::KernelInfo { name: #name, operations: #operations, functions: #functions }
        }
    });
    quote! {
        const DESCRIPTION: ::eigentol::Description = ::eigentol::Description {
            name: #name,
            coordinates: &[#(#coordinates),*],
            inputs: &[#(#inputs),*],
            design: &[#(#design),*],
            outputs: &[#(#outputs),*],
            symmetric_stiffness: #symmetric,
            damping: ::eigentol::DampingKind::#damping,
            kernels: &[#(#kernels),*],
        };
    }
}

/// One constant per name of the declaration, spelled as declared and at its span, so that editors complete it and jump
/// to it.
pub(super) fn handles(mechanism: &Mechanism, topology: &Topology) -> TokenStream {
    let visibility = &mechanism.visibility;
    let handle = |name: &proc_macro2::Ident, kind: &str, index: usize, doc: String| {
        let kind = proc_macro2::Ident::new(kind, proc_macro2::Span::call_site());
        quote_spanned! { name.span() =>
            #[doc = #doc]
            #visibility const #name: ::eigentol::#kind = ::eigentol::#kind(#index);
        }
    };
    let mut handles = TokenStream::new();
    for (index, id) in topology.free.iter().enumerate() {
        let coordinate = &mechanism.coordinates[id.index()];
        let doc = format!("Free coordinate, {}.", coordinate_unit(coordinate.quantity));
        handles.extend(handle(&coordinate.name, "Coordinate", index, doc));
    }
    for (index, input) in mechanism.inputs.iter().enumerate() {
        let doc = with_docs(
            &input.docs,
            format!("Input, declared in {}.", shown(&input.unit)),
        );
        handles.extend(handle(&input.name, "Input", index, doc));
    }
    for (index, variable) in mechanism.design.iter().enumerate() {
        let (unit, scale) = (shown(&variable.unit), variable.unit.scale);
        let mut text = format!(
            "Design variable, nominally {} {unit}",
            variable.nominal / scale
        );
        if variable.tolerance != 0.0 {
            text += &format!(
                ", tolerance {} {unit} either way",
                variable.tolerance / scale
            );
        }
        let doc = with_docs(&variable.docs, text + ".");
        handles.extend(handle(&variable.name, "DesignVariable", index, doc));
    }
    for (index, output) in mechanism.outputs.iter().enumerate() {
        let doc = with_docs(&output.docs, format!("Output, {}.", shown(&output.unit)));
        handles.extend(handle(&output.name, "Output", index, doc));
    }
    handles
}

fn with_docs(docs: &[String], facts: String) -> String {
    match docs {
        [] => facts,
        docs => format!("{}\n\n{facts}", docs.join("\n").trim()),
    }
}

fn shown(unit: &Unit) -> &str {
    if unit.symbol.is_empty() {
        "1"
    } else {
        &unit.symbol
    }
}

fn unit(unit: &Unit) -> TokenStream {
    let Unit { symbol, scale } = unit;
    quote! { ::eigentol::Unit { symbol: #symbol, scale: #scale } }
}

fn coordinate_unit(quantity: CoordinateQuantity) -> &'static str {
    match quantity {
        CoordinateQuantity::Angle => "rad",
        CoordinateQuantity::Displacement => "m",
    }
}
