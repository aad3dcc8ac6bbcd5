//! Converts the compiler's layout of picture numbers to the runtime's types.

use eigentol::{
    BeamInfo, BodyInfo, ElementInfo, JointInfo, LinkInfo, List, PictureInfo, PointInfo, SolidInfo, SolidKind, Text,
    WheelInfo,
};
use eigentol_compiler::mechanics::{self, Picture};
use eigentol_compiler::model::mechanism::Frame;

use crate::description::text;

pub(crate) fn picture(picture: &Picture) -> PictureInfo {
    PictureInfo {
        bodies: list(&picture.bodies, |body| BodyInfo {
            name: text(body.name.as_str()),
            solids: list(&body.solids, |&(solid, hole)| SolidInfo { kind: kind(solid), hole }),
        }),
        beams: list(&picture.beams, |beam| BeamInfo {
            name: text(beam.name.as_str()),
            sections: beam.sections,
            round: beam.round,
        }),
        joints: list(&picture.joints, |joint| {
            let [from, to] = joint.sides.map(body);
            JointInfo {
                name: text(joint.name.as_str()),
                kind: Text::Static(joint.kind),
                from,
                to,
                cut: joint.cut,
                driven: joint.driven,
            }
        }),
        points: list(&picture.points, |(name, frame)| PointInfo { name: text(name), body: body(*frame) }),
        links: list(&picture.links, |link| LinkInfo {
            name: text(link.name.as_str()),
            kind: Text::Static(link.kind),
            ends: link.ends.map(|point| point.0),
        }),
        wheels: list(&picture.wheels, |(name, points)| {
            let [center, on] = points.map(|point| point.0);
            WheelInfo { name: text(name), center, on }
        }),
        elements: list(&picture.elements, |element| ElementInfo {
            name: text(element.name.as_str()),
            kind: text(element.kind.as_str()),
            law: text(element.law.as_str()),
        }),
        numbers: picture.numbers.clone().into(),
        computed: picture.computed.clone().into(),
    }
}

fn list<A, B>(from: &[A], each: impl Fn(&A) -> B) -> List<B> {
    from.iter().map(each).collect::<Vec<_>>().into()
}

fn body(frame: Frame) -> Option<u32> {
    match frame {
        Frame::Ground => None,
        Frame::Body(id) => Some(id.0),
    }
}

fn kind(kind: mechanics::SolidKind) -> SolidKind {
    match kind {
        mechanics::SolidKind::Point => SolidKind::Point,
        mechanics::SolidKind::Rod => SolidKind::Rod,
        mechanics::SolidKind::Disk => SolidKind::Disk,
        mechanics::SolidKind::Cylinder => SolidKind::Cylinder,
        mechanics::SolidKind::Tube => SolidKind::Tube,
        mechanics::SolidKind::Box => SolidKind::Box,
        mechanics::SolidKind::Sphere => SolidKind::Sphere,
        mechanics::SolidKind::Rigid => SolidKind::Rigid,
    }
}
