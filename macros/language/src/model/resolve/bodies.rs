//! Bodies: sums of shapes, with holes.

mod inertia;
mod quantities;
mod shapes;

use std::rc::Rc;

use self::quantities::Quantities;
use self::shapes::SYNONYMS;
pub(super) use self::shapes::{BEAM, Row, SHAFT, SHAPES, SUPERELEMENT};
use super::coordinates;
use super::joints::kinds::Kind;
use super::resolver::Resolver;
use crate::model::mechanism::{Body, Joint, Part};
use crate::model::rules::composite::{GivenInertia, Welded};
use crate::model::rules::physical::Demand;
use crate::model::welded::groups;
use crate::syntax::ast::{self, Term, Unread};

impl Resolver<'_> {
    pub(super) fn bodies(&mut self) -> Vec<Body> {
        let mut bodies = Vec::new();
        for body in self.ast.all::<ast::Body>() {
            let parts = self.parts(body);
            self.parts.push(parts.clone());
            bodies.extend(parts.map(|parts| Body { name: body.name.clone(), parts }));
        }
        bodies
    }

    /// Requires inertias to be physically possible. Only bodies welded together need a possible inertia, not every
    /// single link: robot files are full of links that carry nothing but a frame. Nothing is reported as long as the
    /// welds are unknown.
    pub(super) fn require_inertias(&mut self, joints: &[Joint]) {
        let may_weld =
            |joint: &&ast::Joint| Kind::find(&joint.kind.to_string()).is_none_or(|kind| kind.motions.is_empty());
        let welds = coordinates::joints(self.ast).filter(may_weld).count();
        let known = joints.iter().filter(|joint| joint.steps.is_empty()).count();
        if welds != known || self.scope.is_ambiguous || self.ast.unread.iter().any(Unread::may_connect) {
            return;
        }
        let names: Vec<String> = self.ast.all::<ast::Body>().map(|body| body.name.to_string()).collect();
        for group in groups(names.len(), joints) {
            let bodies = group.into_iter().map(|member| {
                let index = member.body.index();
                let parts = self.parts[index].clone()?;
                Some((names[index].clone(), parts, member.placements))
            });
            let Some(bodies) = bodies.collect::<Option<Vec<_>>>() else {
                continue;
            };
            let in_group = |given: &&GivenInertia| bodies.iter().any(|(name, ..)| *name == given.body);
            let given: Vec<GivenInertia> = self.given_inertias.iter().filter(in_group).cloned().collect();
            let Some(first) = given.first() else {
                continue;
            };
            let (what, extent) = (format!("the inertia of `{}`", first.body), first.extent);
            let values: Vec<_> = given.iter().flat_map(|given| given.central.clone()).collect();
            self.require(what, values, Demand::Inertia(Rc::new(Welded { bodies, given })), extent);
        }
    }

    fn parts(&mut self, body: &ast::Body) -> Option<Vec<Part>> {
        let is_massless = |term: &&Term| term.shape.word == "massless";
        if let Some(massless) = body.terms.iter().find(is_massless) {
            return self.massless(body, massless);
        }
        if let Some(beam) = body.terms.iter().find(|term| term.shape.word == BEAM.word) {
            return self.beam(body, beam).map(|()| Vec::new());
        }
        if let Some(shaft) = body.terms.iter().find(|term| term.shape.word == SHAFT.word) {
            return self.shaft(body, shaft).map(|()| Vec::new());
        }
        if let Some(term) = body.terms.iter().find(|term| term.shape.word == SUPERELEMENT.word) {
            return self.superelement(body, term).map(|()| Vec::new());
        }
        if let Some(speed) = &body.spinning {
            let message = "only a `beam` or a `shaft` can spin about its own bent axis";
            let help = "turn the body by a joint: `revolute(x) ... driven at omega`";
            return self.refuse_with_help(speed.extent, message, help);
        }
        let right = self.first_is_solid(body);
        let resolved: Vec<Option<Part>> =
            body.terms.iter().map(|term| self.part(&body.name.to_string(), term)).collect();
        right?;
        let parts: Vec<Part> = resolved.into_iter().collect::<Option<_>>()?;
        if let Some(hole) = body.terms.iter().find(|term| term.hole) {
            self.require(
                format!("the holes of `{}`", body.name),
                Vec::new(),
                Demand::Holes(Rc::from(parts.as_slice())),
                &hole.shape.word,
            );
        }
        Some(parts)
    }

    /// A massless body is a single term that is neither cut out nor placed.
    fn massless(&mut self, body: &ast::Body, massless: &Term) -> Option<Vec<Part>> {
        let signature = self.signature(&massless.shape, "shape", SHAPES, &SYNONYMS)?;
        self.arguments(&massless.shape, signature);
        let word = &massless.shape.word;
        if body.terms.len() > 1 || massless.hole {
            let message = "`massless` stands alone: it cannot be part of a sum";
            return self.refuse(word, message);
        }
        if let Some(placement) = &massless.placement {
            let message = "a massless body has no shape to place";
            let help = "place the joint instead";
            return self.refuse_with_help(placement.keyword, message, help);
        }
        Some(Vec::new())
    }

    fn first_is_solid(&mut self, body: &ast::Body) -> Option<()> {
        let first = body.terms.first()?;
        if first.hole {
            let message = "the first shape of a body cannot be a hole: there is nothing to cut";
            return self.refuse(&first.shape.word, message);
        }
        Some(())
    }

    fn part(&mut self, body: &str, term: &Term) -> Option<Part> {
        let placement = self.placement(term.placement.as_ref(), "a shape's place");
        let signature = self.signature(&term.shape, "shape", SHAPES, &SYNONYMS)?;
        let arguments = self.arguments(&term.shape, signature);
        let shape = (signature.read)(&mut Quantities::new(self, arguments, body));
        Some(Part { hole: term.hole, shape: shape?, placement: placement? })
    }
}
