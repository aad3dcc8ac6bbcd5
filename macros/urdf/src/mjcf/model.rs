//! Bodies, joints, sites and forces of joints, and the text of the whole.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::attributes::{Angles, exactly, number, numbers, pose, required, unit, vector};
use super::element::Element;
use super::meshes::Meshes;
use super::solids::{Masses, Source, mass};
use super::{Include, remark};
use crate::assemble::{self, Body};
use crate::error::{ImportError, Mistake, Reason};
use crate::geometry::{Pose, Vector};
use crate::names::Names;
use crate::note::Note;
use crate::write::{body, direction, number as text_of, placed, vector as vector_text};

type Result<T> = std::result::Result<T, ImportError>;

/// A joint with one coordinate.
#[derive(Clone, Debug)]
pub(super) struct Coordinate {
    pub(super) name: String,
    pub(super) is_angle: bool,
    /// Where the file's coordinate stands when the declared one is zero.
    pub(super) reference: f64,
    /// Where its spring is at rest, in the declared coordinate.
    pub(super) rest: f64,
}

/// A body that others may refer to.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub(super) name: String,
    /// In the world, at the reference.
    pub(super) pose: Pose,
}

/// What of joints has no meaning in a mechanism.
const IGNORED_OF_JOINTS: [&str; 3] = ["range", "frictionloss", "actuatorfrcrange"];

pub(super) struct Translation<'a> {
    masses: Masses<'a>,
    /// What the masses of all bodies are to add up to.
    pub(super) total: Option<f64>,
    /// By which all masses are multiplied.
    pub(super) share: f64,
    pub(super) gravity: Vector,
    pub(super) names: Names,
    /// By their names in the file.
    pub(super) joints: BTreeMap<String, Coordinate>,
    pub(super) bodies: BTreeMap<String, Placed>,
    /// Sites by their names in the file: the points that they are.
    pub(super) sites: BTreeMap<String, String>,
    /// Bodies, joints, points, forces and constraints as text.
    pub(super) lines: [Vec<(String, String)>; 5],
    pub(super) notes: Vec<Note>,
    pub(super) ignored: BTreeMap<String, Vec<String>>,
    /// Whether some joint moves by a displacement, and some by an angle.
    pub(super) moves: [bool; 2],
    unnamed: usize,
}

const JOINTS: usize = 1;
pub(super) const POINTS: usize = 2;
pub(super) const FORCES: usize = 3;
pub(super) const CONSTRAINTS: usize = 4;

impl<'a> Translation<'a> {
    pub(super) fn new(root: &'a Element, include: Include<'a>) -> Result<Self> {
        let mut notes = Vec::new();
        let mut settings = BTreeMap::new();
        for compiler in root.named("compiler") {
            settings.extend(compiler.attributes.clone());
        }
        let setting = |name: &str| settings.get(name).map(String::as_str);
        for name in ["balanceinertia", "boundmass", "boundinertia", "alignfree"] {
            if setting(name).is_some_and(|text| !["false", "0", "-1"].contains(&text)) {
                notes.push(remark(format!("`{name}` of the compiler is not followed")));
            }
        }
        let degrees = setting("angle") != Some("radian");
        let groups = match settings.get("inertiagrouprange").map(|text| text.split_whitespace().map(str::parse::<f64>))
        {
            Some(mut two) => match (two.next(), two.next()) {
                (Some(Ok(low)), Some(Ok(high))) => [low, high],
                _ => [0.0, 5.0],
            },
            None => [0.0, 5.0],
        };
        let mut gravity = [0.0, 0.0, -9.81];
        for option in root.named("option") {
            gravity = vector(option, "gravity", gravity)?;
            for name in ["wind", "density", "viscosity"] {
                if option.get(name).is_some_and(|text| text.split_whitespace().any(|x| x.parse() != Ok(0.0))) {
                    notes.push(remark(format!("`{name}`: the medium is left out")));
                }
            }
            if option.named("flag").any(|flag| flag.get("gravity") == Some("disable")) {
                gravity = [0.0; 3];
            }
        }
        Ok(Self {
            masses: Masses {
                angles: Angles {
                    scale: if degrees { std::f64::consts::PI / 180.0 } else { 1.0 },
                    order: setting("eulerseq").unwrap_or("xyz").to_owned(),
                },
                source: match setting("inertiafromgeom") {
                    Some("true") => Source::Geoms,
                    Some("false") => Source::Inertial,
                    _ => Source::Either,
                },
                groups,
                meshes: Meshes::new(root, setting("meshdir").or(setting("assetdir")).unwrap_or_default(), include),
            },
            total: setting("settotalmass").and_then(|text| text.trim().parse().ok()).filter(|total| *total > 0.0),
            share: 1.0,
            gravity,
            names: Names::default(),
            joints: BTreeMap::new(),
            bodies: BTreeMap::new(),
            sites: BTreeMap::new(),
            lines: Default::default(),
            notes,
            ignored: BTreeMap::new(),
            moves: [false; 2],
            unnamed: 0,
        })
    }

    pub(super) fn name_joints(&mut self, of: &Element, mistakes: &mut Vec<Mistake>) {
        for body in of.named("body") {
            for joint in body.children.iter().filter(|own| ["joint", "freejoint"].contains(&&*own.tag)) {
                let Some(name) = joint.get("name") else { continue };
                let own =
                    Coordinate { name: self.names.of_file(name, "joint"), is_angle: true, reference: 0.0, rest: 0.0 };
                if self.joints.insert(name.to_owned(), own).is_some() {
                    mistakes.extend(joint.mistake(Reason::Twice { what: "joint", name: name.to_owned() }).mistakes);
                }
            }
            self.name_joints(body, mistakes);
        }
    }

    /// The mass of all bodies in one, or in the world.
    pub(super) fn masses(&self, of: &Element) -> Result<f64> {
        let each = of.named("body").map(|body| {
            let own = mass(body, &self.masses)?.map_or(0.0, |own| own.mass);
            Ok(own + self.masses(body)?)
        });
        each.sum()
    }

    fn unnamed(&mut self, kind: &str) -> String {
        self.unnamed += 1;
        self.names.unique(&format!("{kind}_{}", self.unnamed), kind)
    }

    /// What is in a body or in the world.
    pub(super) fn inside(&mut self, own: &Element, placed: &Placed, mistakes: &mut Vec<Mistake>) {
        for site in own.named("site") {
            if let Err(error) = self.site(site, placed) {
                mistakes.extend(error.mistakes);
            }
        }
        for child in &own.children {
            match &*child.tag {
                "body" => match self.body(child, placed) {
                    Ok(child_placed) => self.inside(child, &child_placed, mistakes),
                    Err(error) => mistakes.extend(error.mistakes),
                },
                "frame" | "replicate" | "attach" | "composite" | "flexcomp" => {
                    let help = "let MuJoCo write the model out: `mj_saveLastXML`";
                    mistakes.extend(child.wrong(format!("`{}` is not read", child.tag), help).mistakes);
                }
                _ => {}
            }
        }
    }

    fn site(&mut self, site: &Element, of: &Placed) -> Result<()> {
        // A site without a name is a picture.
        let Some(original) = site.get("name") else { return Ok(()) };
        let frame = pose(site, &self.masses.angles)?;
        let name = self.names.of_file(original, "site");
        self.sites.insert(original.to_owned(), name.clone());
        self.point(&name, &of.name, &frame);
        Ok(())
    }

    /// Declares a point.
    pub(super) fn point(&mut self, name: &str, body: &str, frame: &Pose) {
        self.lines[POINTS].push((name.to_owned(), format!("point {name}: {body}{}", placed(frame))));
    }

    fn body(&mut self, own: &Element, parent: &Placed) -> Result<Placed> {
        let frame = pose(own, &self.masses.angles)?;
        let name = match own.get("name") {
            Some(original) => self.names.of_file(original, "body"),
            None => self.unnamed("body"),
        };
        let there = Placed { name: name.clone(), pose: parent.pose.then(&frame) };
        if let Some(original) = own.get("name")
            && self.bodies.insert(original.to_owned(), there.clone()).is_some()
        {
            return Err(own.mistake(Reason::Twice { what: "body", name: original.to_owned() }));
        }
        if own.get("gravcomp").is_some_and(|text| text.parse() != Ok(0.0)) {
            self.notes.push(remark(format!("`gravcomp` of `{name}` is left out: its weight acts")));
        }
        let mass = mass(own, &self.masses)?;
        let mass = mass.map(|total| {
            let (center, inertia) = total.central();
            assemble::Mass {
                mass: self.share * total.mass,
                center,
                inertia: inertia.map(|row| row.map(|x| self.share * x)),
            }
        });
        let joints: Vec<&Element> =
            own.children.iter().filter(|child| ["joint", "freejoint"].contains(&&*child.tag)).collect();
        let (mut from, mut frame) = (parent.name.clone(), frame);
        for (k, joint) in joints.iter().enumerate() {
            let to = if k + 1 == joints.len() {
                name.clone()
            } else {
                let between = self.names.unique(&format!("{name}_{}", k + 1), "body");
                self.lines[0].push((String::new(), format!("body {between}: massless")));
                between
            };
            self.joint(joint, [&from, &to], &frame)?;
            (from, frame) = (to, Pose::default());
        }
        if joints.is_empty() {
            let weld = self.names.unique(&format!("weld_{name}"), "joint");
            let line = format!("joint {weld}: fixed from {from} to {name}{}", placed(&frame));
            self.lines[JOINTS].push((String::new(), line));
        }
        let declared = Body { name: name.clone(), mass };
        self.lines[0].push((name, body(&declared)));
        Ok(there)
    }

    /// A joint between two frames that coincide at the reference, about an anchor in them.
    fn joint(&mut self, own: &Element, [from, to]: [&str; 2], frame: &Pose) -> Result<()> {
        let name = match own.get("name") {
            Some(original) => self.joints.get(original).map(|known| known.name.clone()).unwrap_or_default(),
            None => self.unnamed("joint"),
        };
        for attribute in IGNORED_OF_JOINTS {
            let says = own.get(attribute).is_some_and(|text| text.split_whitespace().any(|x| x.parse() != Ok(0.0)));
            if says && (attribute != "range" || own.get("limited") != Some("false")) {
                self.ignored.entry(attribute.to_owned()).or_default().push(name.clone());
            }
        }
        let kind = if own.tag == "freejoint" { "free" } else { own.get("type").unwrap_or("hinge") };
        let anchor = if kind == "free" { [0.0; 3] } else { vector(own, "pos", [0.0; 3])? };
        let seat = frame.then(&Pose { offset: anchor, rotations: Vec::new() });
        let place = match anchor {
            [0.0, 0.0, 0.0] => placed(&seat),
            // A placement for each side.
            _ if seat == Pose::default() => format!(" at [0, 0, 0] m, at {} m on {to}", vector_text(&anchor)),
            _ => format!("{}, at {} m on {to}", placed(&seat), vector_text(&anchor)),
        };
        let motions = match kind {
            "hinge" | "slide" => {
                let axis = exactly::<3>(own, "axis")?.unwrap_or([0.0, 0.0, 1.0]);
                if axis == [0.0; 3] {
                    return Err(own.mistake(Reason::NoAxis(name)));
                }
                // A unit vector along an axis is written as its name.
                let axis = direction(if axis.iter().filter(|x| **x != 0.0).count() == 1 { axis } else { unit(axis) });
                format!("{}({axis})", if kind == "hinge" { "revolute" } else { "prismatic" })
            }
            "ball" | "free" => {
                let turns = [("yaw", "z"), ("pitch", "y"), ("roll", "x")];
                let slides = [("px", "x"), ("py", "y"), ("pz", "z")];
                let all = if kind == "free" { [&slides[..], &turns].concat() } else { turns.to_vec() };
                let each = all.into_iter().map(|(ending, axis)| {
                    let coordinate = self.names.unique(&format!("{name}_{ending}"), "coordinate");
                    format!("{coordinate}: {axis}")
                });
                let each: Vec<String> = each.collect();
                format!("{}({})", if kind == "free" { "free" } else { "spherical" }, each.join(", "))
            }
            other => {
                let message = format!("`{other}` is not a type of joint");
                return Err(own.wrong(message, "known are hinge, slide, ball, free"));
            }
        };
        self.lines[JOINTS].push((name.clone(), format!("joint {name}: {motions} from {from} to {to}{place}")));
        self.moves = [self.moves[0] || ["slide", "free"].contains(&kind), self.moves[1] || kind != "slide"];
        if ["hinge", "slide"].contains(&kind) {
            return self.resistance(own, &name, kind == "hinge");
        }
        // It has no coordinate of its name, which something else could follow.
        if let Some(original) = own.get("name") {
            self.joints.remove(original);
        }
        self.resistance_of_several(
            own,
            &name,
            kind,
            [(from, &seat), (to, &Pose { offset: anchor, rotations: Vec::new() })],
        )
    }

    /// Spring, damper and armature of a joint with one coordinate.
    fn resistance(&mut self, own: &Element, name: &str, is_angle: bool) -> Result<()> {
        let scale = if is_angle { self.masses.angles.scale } else { 1.0 };
        let reference = scale * number(own, "ref", 0.0)?;
        let units = if is_angle { ["N*m/rad", "rad", "N*m*s/rad", "kg*m^2"] } else { ["N/m", "m", "N*s/m", "kg"] };
        let rest = scale * number(own, "springref", 0.0)? - reference;
        if let Some(original) = own.get("name") {
            let coordinate = Coordinate { name: name.to_owned(), is_angle, reference, rest };
            self.joints.insert(original.to_owned(), coordinate);
        }
        let [stiffness, damping, armature] =
            [("stiffness", "spring"), ("damping", "damping"), ("armature", "armature")].map(|(attribute, word)| {
                let all = numbers(own, attribute)?;
                if all.iter().skip(1).any(|x| *x != 0.0) {
                    self.notes.push(remark(format!(
                        "`{attribute}` of `{name}` is a polynomial: only its first number is taken"
                    )));
                }
                let value = all.first().copied().unwrap_or(0.0);
                let force =
                    if value == 0.0 { String::new() } else { self.names.unique(&format!("{word}_of_{name}"), "force") };
                Ok((value, force))
            });
        let mut line = |(value, force): (f64, String), law: &dyn Fn(String) -> String| {
            if value != 0.0 {
                self.lines[FORCES].push((String::new(), format!("force {force}: {}", law(text_of(value)))));
            }
        };
        let rest = if rest == 0.0 { String::new() } else { format!(", rest: {} {}", text_of(rest), units[1]) };
        line(stiffness?, &|k| format!("spring(on: {name}, stiffness: {k} {}{rest})", units[0]));
        line(damping?, &|c| format!("damper(on: {name}, damping: {c} {})", units[2]));
        line(armature?, &|j| format!("inerter(on: {name}, inertance: {j} {})", units[3]));
        Ok(())
    }

    /// Of a ball, as a bushing; of a free joint nothing.
    fn resistance_of_several(&mut self, own: &Element, name: &str, kind: &str, ends: [(&str, &Pose); 2]) -> Result<()> {
        let values = [number(own, "stiffness", 0.0)?, number(own, "damping", 0.0)?, number(own, "armature", 0.0)?];
        if values[2] != 0.0 {
            self.notes.push(remark(format!("the armature of `{name}`, which has several coordinates, is left out")));
        }
        if values[0] == 0.0 && values[1] == 0.0 {
            return Ok(());
        }
        if kind == "free" {
            self.notes.push(remark(format!("the stiffness and damping of the free joint `{name}` are left out")));
            return Ok(());
        }
        let points = ["seat", "ball"].map(|ending| self.names.unique(&format!("{name}_{ending}"), "point"));
        for (point, (body, frame)) in points.iter().zip(ends) {
            self.point(point, body, frame);
        }
        let force = self.names.unique(&format!("bushing_of_{name}"), "force");
        let mut line = format!("force {force}: bushing(from: {}, to: {}", points[0], points[1]);
        for (value, word, unit) in
            [(values[0], "turning_stiffness", "N*m/rad"), (values[1], "turning_damping", "N*m*s/rad")]
        {
            if value != 0.0 {
                let _ = write!(line, ", {word}: {} {unit}", vector_text(&[value; 3]));
            }
        }
        self.lines[FORCES].push((String::new(), line + ")"));
        if values[0] != 0.0 {
            let text = format!("the spring of the ball `{name}` is that of small angles");
            self.notes.push(remark(text));
        }
        Ok(())
    }

    /// The coordinate of a joint that an element names.
    pub(super) fn coordinate(&self, of: &Element, attribute: &'static str) -> Result<Coordinate> {
        let name = required(of, attribute)?;
        self.joints.get(name).cloned().ok_or_else(|| {
            of.mistake(Reason::Unknown { what: "joint with one coordinate", name: name.to_owned(), near: None })
        })
    }
}
