//! How to interpret the numbers of a picture, for the runtime.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::base::names::written;
use crate::mechanics::Picture;
use crate::model::mechanism::Frame;

/// `const PICTURE`.
pub(super) fn info(picture: &Picture) -> TokenStream {
    let bodies = picture.bodies.iter().map(|body| {
        let name = text(&body.name);
        let solids = body.solids.iter().map(|(kind, hole)| {
            let kind = Ident::new(&format!("{kind:?}"), Span::call_site());
            quote! { ::eigentol::SolidInfo { kind: ::eigentol::SolidKind::#kind, hole: #hole } }
        });
        let solids = list(solids);
        quote! { ::eigentol::BodyInfo { name: #name, solids: #solids } }
    });
    let beams = picture.beams.iter().map(|beam| {
        let name = text(&beam.name);
        let (sections, round) = (Literal::u32_unsuffixed(beam.sections), beam.round);
        quote! { ::eigentol::BeamInfo { name: #name, sections: #sections, round: #round } }
    });
    let joints = picture.joints.iter().map(|joint| {
        let (name, kind) = (text(&joint.name), text(joint.kind));
        let (cut, driven) = (joint.cut, joint.driven);
        let [from, to] = joint.sides.map(body);
        quote! {
            ::eigentol::JointInfo {
                name: #name, kind: #kind, from: #from, to: #to, cut: #cut, driven: #driven
            }
        }
    });
    let points = picture.points.iter().map(|(name, frame)| {
        let (name, body) = (text(name), body(*frame));
        quote! { ::eigentol::PointInfo { name: #name, body: #body } }
    });
    let links = picture.links.iter().map(|link| {
        let (name, kind) = (text(&link.name), text(link.kind));
        let [from, to] = link.ends.map(|point| Literal::u32_unsuffixed(point.0));
        quote! { ::eigentol::LinkInfo { name: #name, kind: #kind, ends: [#from, #to] } }
    });
    let wheels = picture.wheels.iter().map(|(name, points)| {
        let name = text(name);
        let [center, on] = points.map(|point| Literal::u32_unsuffixed(point.0));
        quote! { ::eigentol::WheelInfo { name: #name, center: #center, on: #on } }
    });
    let elements = picture.elements.iter().map(|element| {
        let (name, kind, law) = (text(&element.name), text(&element.kind), text(&element.law));
        quote! { ::eigentol::ElementInfo { name: #name, kind: #kind, law: #law } }
    });
    let numbers = picture.numbers.iter().map(|value| quote!(#value));
    let computed = picture.computed.iter().map(|&index| {
        let literal = Literal::u32_unsuffixed(index);
        quote!(#literal)
    });
    let (bodies, beams) = (list(bodies), list(beams));
    let (joints, points) = (list(joints), list(points));
    let (links, wheels, elements) = (list(links), list(wheels), list(elements));
    let (numbers, computed) = (list(numbers), list(computed));
    quote! {
        const PICTURE: ::eigentol::PictureInfo = ::eigentol::PictureInfo {
            bodies: #bodies,
            beams: #beams,
            joints: #joints,
            points: #points,
            links: #links,
            wheels: #wheels,
            elements: #elements,
            numbers: #numbers,
            computed: #computed,
        };
    }
}

fn list(entries: impl Iterator<Item = TokenStream>) -> TokenStream {
    quote! { ::eigentol::Shared::Static(&[#(#entries),*]) }
}

fn text(text: &str) -> TokenStream {
    let text = written(text);
    quote! { ::eigentol::Shared::Static(#text) }
}

fn body(frame: Frame) -> TokenStream {
    match frame {
        Frame::Ground => quote!(::core::option::Option::None),
        Frame::Body(id) => {
            let body = Literal::u32_unsuffixed(id.0);
            quote!(::core::option::Option::Some(#body))
        }
    }
}
