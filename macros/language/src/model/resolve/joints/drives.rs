//! How the coordinates of a joint move: free, driven at a given speed, or coasting.

use proc_macro2::Ident;

use super::super::coordinates;
use super::super::coordinates::DeclaredMotion;
use super::super::resolver::Resolver;
use super::super::typed::ValueContext;
use super::kinds::Kind;
use crate::base::ids::{CoordinateId, JointId};
use crate::base::nearest::nearest;
use crate::base::span::Extent;
use crate::model::expression::Expr;
use crate::model::mechanism::Motion;
use crate::syntax::ast::{Coast, Drive, Joint, JointClause, Shake};

/// The coordinates of a joint while its clauses are read.
struct Motions {
    ids: Vec<CoordinateId>,
    /// The motion declared for each so far.
    said: Vec<DeclaredMotion>,
    motions: Vec<Motion>,
}

impl Resolver<'_> {
    /// The motion of every coordinate of the joint: free, driven at its one declared speed, or coasting.
    pub(super) fn drives(&mut self, joint: &Joint, id: JointId, kind: Option<&'static Kind>) -> Option<Vec<Motion>> {
        let ids = self.coordinates_of(id);
        let count = ids.len();
        let mut motions = Motions { ids, said: vec![DeclaredMotion::Free; count], motions: vec![Motion::Free; count] };
        let mut right = Some(());
        for clause in &joint.clauses {
            let clause = match clause {
                JointClause::Drive(drive) => self.drive(joint, kind, drive, &mut motions),
                JointClause::Coast(coast) => self.coast(joint, kind, coast, &mut motions),
                JointClause::Shake(shake) => self.shake(joint, kind, shake, &mut motions),
                JointClause::Placement { .. } | JointClause::Cut(_) => Some(()),
            };
            right = right.and(clause);
        }
        right.map(|()| motions.motions)
    }

    fn drive(&mut self, joint: &Joint, kind: Option<&Kind>, drive: &Drive, motions: &mut Motions) -> Option<()> {
        let who = (drive.coordinate.as_ref(), drive.keyword);
        let index = kind.and_then(|kind| self.given_place(joint, kind, who, &motions.ids, DeclaredMotion::Driven));
        let Some(index) = index else {
            // Its value may be wrong as well, so check it too.
            self.scalar(&drive.speed, ValueContext::Parameter);
            return None;
        };
        let name = drive.coordinate.as_ref();
        self.say(motions, index, DeclaredMotion::Driven, name, drive.keyword)?;
        motions.motions[index] = self.motion(drive, motions.ids[index])?;
        Some(())
    }

    /// Reads a coasting clause; without a name all coordinates coast.
    fn coast(&mut self, joint: &Joint, kind: Option<&Kind>, coast: &Coast, motions: &mut Motions) -> Option<()> {
        self.has_motions(kind?, "coast", coast.keyword)?;
        let places = match &coast.coordinate {
            Some(name) => {
                let index = self.place_named(name, &motions.ids)?;
                index..=index
            }
            // Without coordinates the axes are wrong, which has been reported.
            None => 0..=motions.ids.len().checked_sub(1)?,
        };
        self.is_not_cut(joint, "coast", coast.keyword)?;
        let name = coast.coordinate.as_ref();
        for index in places {
            self.say(motions, index, DeclaredMotion::Coasting, name, coast.keyword)?;
            motions.motions[index] = Motion::Coasting;
        }
        Some(())
    }

    /// Declares the motion of a coordinate, which is allowed only once.
    fn say(
        &mut self,
        motions: &mut Motions,
        index: usize,
        motion: DeclaredMotion,
        name: Option<&Ident>,
        keyword: Extent,
    ) -> Option<()> {
        let before = std::mem::replace(&mut motions.said[index], motion);
        if before == DeclaredMotion::Free {
            return Some(());
        }
        if before != motion {
            let name = self.coordinates.get(motions.ids[index].index())?.name;
            let message = format!("`{name}` is both {} and {}", before.word(), motion.word());
            let help = match (before, motion) {
                (DeclaredMotion::Shaken, _) | (_, DeclaredMotion::Shaken) => {
                    "a shaken coordinate moves about zero: keep one of them"
                }
                _ => "a drive prescribes the speed, a coasting coordinate finds its own: keep one of them",
            };
            return self.refuse_with_help(keyword, message, help);
        }
        let what = name.map_or("this joint".to_string(), |name| format!("`{name}`"));
        let message = match motion {
            DeclaredMotion::Coasting => format!("{what} is said to coast twice"),
            _ => format!("{what} is {} twice", motion.word()),
        };
        self.refuse(keyword, message)
    }

    /// A shaken coordinate is held at zero in the steady motion.
    fn shake(&mut self, joint: &Joint, kind: Option<&Kind>, shake: &Shake, motions: &mut Motions) -> Option<()> {
        let keyword = Extent::from(shake.call.word.span());
        let who = (shake.coordinate.as_ref(), keyword);
        let index = self.given_place(joint, kind?, who, &motions.ids, DeclaredMotion::Shaken)?;
        let name = shake.coordinate.as_ref();
        self.say(motions, index, DeclaredMotion::Shaken, name, keyword)?;
        motions.motions[index] = Motion::Driven(Expr::Number(0.0));
        Some(())
    }

    /// The index within the joint of the coordinate that a clause drives or shakes.
    fn given_place(
        &mut self,
        joint: &Joint,
        kind: &Kind,
        (coordinate, keyword): (Option<&Ident>, Extent),
        ids: &[CoordinateId],
        motion: DeclaredMotion,
    ) -> Option<usize> {
        let word = motion.word();
        self.has_motions(kind, &format!("be {word}"), keyword)?;
        let index = match coordinate {
            Some(name) => self.place_named(name, ids)?,
            None if ids.len() == 1 => 0,
            None => {
                let (names, quoted) = self.names_of(ids);
                // Without coordinates the axes are wrong, which has been reported.
                let first = names.first()?;
                return self.refuse_with_help(
                    keyword,
                    format!("`{}` has the coordinates {quoted}", joint.name),
                    match motion {
                        DeclaredMotion::Shaken => {
                            format!("say which one is shaken: `{first} shaken(...)`")
                        }
                        _ => format!("say which one is driven: `{first} driven at ...`"),
                    },
                );
            }
        };
        self.is_not_cut(joint, &format!("be {word}"), keyword)?;
        Some(index)
    }

    fn has_motions(&mut self, kind: &Kind, verb: &str, keyword: Extent) -> Option<()> {
        if kind.motions.is_empty() {
            let message = format!("a fixed joint cannot {verb}");
            return self.refuse(keyword, message);
        }
        Some(())
    }

    fn is_not_cut(&mut self, joint: &Joint, verb: &str, keyword: Extent) -> Option<()> {
        if coordinates::is_cut(joint) {
            return self.refuse_with_help(
                keyword,
                format!("a cut joint cannot {verb}: it has no coordinates"),
                "cut another joint of the loop",
            );
        }
        Some(())
    }

    /// The index within the joint of the coordinate with this name.
    fn place_named(&mut self, name: &Ident, ids: &[CoordinateId]) -> Option<usize> {
        let (names, quoted) = self.names_of(ids);
        let text = name.to_string();
        let index = names.iter().position(|other| *other == text);
        if index.is_none() && !names.is_empty() {
            let message = format!("`{text}` is not a coordinate of this joint");
            let help = match nearest(&text, names.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("it has {quoted}"),
            };
            self.diagnostics.error_with_help(name, message, help);
        }
        index
    }

    /// Names of coordinates, and their list for messages.
    fn names_of(&self, ids: &[CoordinateId]) -> (Vec<String>, String) {
        let names: Vec<String> = ids
            .iter()
            .filter_map(|id| self.coordinates.get(id.index()))
            .map(|coordinate| coordinate.name.to_string())
            .collect();
        let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        (names, quoted.join(", "))
    }

    fn motion(&mut self, drive: &Drive, coordinate: CoordinateId) -> Option<Motion> {
        let quantity = self.coordinates.get(coordinate.index())?.quantity?;
        let dimension = coordinates::rate_dimension(quantity);
        let what = "the speed of this drive";
        let speed = self.scalar_of(&drive.speed, dimension, what)?;
        self.require_finite(std::slice::from_ref(&speed), what, drive.speed.extent);
        Some(Motion::Driven(speed))
    }
}
