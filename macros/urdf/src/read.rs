//! From XML to a robot. A wrong element is reported, and reading continues after it.

use std::collections::BTreeMap;

use eigentol_compiler::base::nearest::nearest;
use roxmltree::{Document, Node};

use crate::error::{ImportError, MOST, Mistake, Reason};
use crate::geometry::{Inertial, Matrix, Pose, Vector, norm};
use crate::robot::{Joint, JointKind, Link, Mimic, Robot, SourcePosition};

const KINDS: [(&str, JointKind); 6] = [
    ("revolute", JointKind::Revolute),
    ("continuous", JointKind::Revolute),
    ("prismatic", JointKind::Prismatic),
    ("fixed", JointKind::Fixed),
    ("floating", JointKind::Floating),
    ("planar", JointKind::Planar),
];

/// Reads a file.
pub(crate) fn read(text: &str) -> Result<Robot, ImportError> {
    let only = |place: SourcePosition, reason| ImportError { mistakes: vec![place.mistake(reason)] };
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let place = SourcePosition { line: at.row, column: at.col };
        only(place, Reason::Xml(error.to_string()))
    })?;
    let root = document.root_element();
    let mut reader = Reader { document: &document, mistakes: Vec::new(), ignored: BTreeMap::new() };
    let at = reader.place(root);
    if root.tag_name().name() != "robot" {
        return Err(only(at, Reason::NotARobot(root.tag_name().name().to_owned())));
    }
    let is_macro = |node: &Node| node.tag_name().namespace().is_some_and(|uri| uri.contains("xacro"));
    if let Some(node) = root.children().find(is_macro) {
        return Err(only(reader.place(node), Reason::Template));
    }
    let elements = root.children().filter(Node::is_element).count();
    if elements > MOST {
        return Err(only(at, Reason::TooLarge(elements)));
    }
    let links = reader.links(root);
    if links.is_empty() && reader.mistakes.is_empty() {
        reader.mistakes.push(at.mistake(Reason::NoLink));
    }
    let joints = reader.joints(root, &links);
    reader.ignore_others(root, "the robot", "robot", &["link", "joint"]);
    if !reader.mistakes.is_empty() {
        let mut mistakes = reader.mistakes;
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        return Err(ImportError { mistakes });
    }
    Ok(Robot {
        name: root.attribute("name").unwrap_or_default().trim().to_owned(),
        at,
        links,
        joints,
        ignored: reader.ignored,
    })
}

struct Reader<'a> {
    document: &'a Document<'a>,
    mistakes: Vec<Mistake>,
    ignored: BTreeMap<(&'static str, String), Vec<String>>,
}

fn children<'a>(node: Node<'a, 'a>, tag: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

fn child<'a>(node: Node<'a, 'a>, tag: &str) -> Option<Node<'a, 'a>> {
    children(node, tag).next()
}

impl<'a> Reader<'a> {
    fn place(&self, node: Node) -> SourcePosition {
        let at = self.document.text_pos_at(node.range().start);
        SourcePosition { line: at.row, column: at.col }
    }

    fn report(&mut self, node: Node, reason: Reason) {
        let mistake = self.place(node).mistake(reason);
        self.mistakes.push(mistake);
    }

    /// Records elements that have no meaning here.
    fn ignore_others(&mut self, node: Node, of: &'static str, name: &str, known: &[&str]) {
        for other in node.children().filter(Node::is_element) {
            let tag = other.tag_name().name();
            if !known.contains(&tag) {
                let names = self.ignored.entry((of, tag.to_owned())).or_default();
                if names.last().is_none_or(|last| last != name) {
                    names.push(name.to_owned());
                }
            }
        }
    }

    fn attribute(&mut self, node: Node<'a, 'a>, attribute: &'static str) -> Option<&'a str> {
        let text = node.attribute(attribute).map(str::trim).filter(|text| !text.is_empty());
        if text.is_none() {
            let element = node.tag_name().name().to_owned();
            self.report(node, Reason::MissingAttribute { element, attribute });
        }
        text
    }

    fn links(&mut self, root: Node<'a, 'a>) -> Vec<Link> {
        let mut links: Vec<Link> = Vec::new();
        for node in children(root, "link") {
            let Some(name) = self.attribute(node, "name") else {
                continue;
            };
            if links.iter().any(|link| link.name == name) {
                let name = name.to_owned();
                self.report(node, Reason::Twice { what: "link", name });
                continue;
            }
            self.ignore_others(node, "links", name, &["inertial"]);
            let inertial = child(node, "inertial").and_then(|inertial| self.inertial(inertial, name));
            links.push(Link { name: name.to_owned(), at: self.place(node), inertial });
        }
        links
    }

    fn inertial(&mut self, node: Node<'a, 'a>, link: &str) -> Option<Inertial> {
        let pose = self.origin(node);
        let mass = self.needed(node, "mass", link).and_then(|mass| self.needed_number(mass, "value"));
        let inertia = self.needed(node, "inertia", link).and_then(|inertia| self.tensor(inertia));
        let mass = mass?;
        if mass < 0.0 {
            let link = link.to_owned();
            self.report(node, Reason::NegativeMass { link, mass });
            return None;
        }
        Some(Inertial { pose: pose?, mass, inertia: inertia? })
    }

    fn needed(&mut self, node: Node<'a, 'a>, element: &'static str, name: &str) -> Option<Node<'a, 'a>> {
        let found = child(node, element);
        if found.is_none() {
            let of = format!("the `{}` of `{name}`", node.tag_name().name());
            self.report(node, Reason::MissingElement { of, element });
        }
        found
    }

    fn tensor(&mut self, node: Node<'a, 'a>) -> Option<Matrix> {
        let [xx, yy, zz, xy, yz, xz] =
            ["ixx", "iyy", "izz", "ixy", "iyz", "ixz"].map(|entry| self.needed_number(node, entry));
        let (xy, yz, xz) = (xy?, yz?, xz?);
        Some([[xx?, xy, xz], [xy, yy?, yz], [xz, yz, zz?]])
    }

    fn joints(&mut self, root: Node<'a, 'a>, links: &[Link]) -> Vec<Joint> {
        let mut names: Vec<&str> = Vec::new();
        let mut nodes = Vec::new();
        for node in children(root, "joint") {
            let Some(name) = self.attribute(node, "name") else {
                continue;
            };
            if names.contains(&name) {
                let name = name.to_owned();
                self.report(node, Reason::Twice { what: "joint", name });
                continue;
            }
            names.push(name);
            nodes.push(node);
        }
        let joints = nodes.iter().zip(&names).map(|(&node, &name)| self.joint(node, name, links, &names));
        let joints: Vec<Option<Joint>> = joints.collect();
        joints.into_iter().flatten().collect()
    }

    fn joint(&mut self, node: Node<'a, 'a>, name: &str, links: &[Link], names: &[&str]) -> Option<Joint> {
        const KNOWN: [&str; 6] = ["origin", "parent", "child", "axis", "mimic", "dynamics"];
        self.ignore_others(node, "joints", name, &KNOWN);
        let kind = self.attribute(node, "type").and_then(|kind| self.kind(node, kind));
        let parent = self.link_of(node, "parent", name, links);
        let child_link = self.link_of(node, "child", name, links);
        let pose = self.origin(node);
        let axis = match child(node, "axis") {
            Some(axis) => self.vector(axis, "xyz", [1.0, 0.0, 0.0]),
            None => Some([1.0, 0.0, 0.0]),
        };
        let damping = self.dynamics(node, name);
        let mimic = match child(node, "mimic") {
            Some(mimic) => self.mimic(mimic, names).map(Some),
            None => Some(None),
        };
        let (kind, axis) = (kind?, axis?);
        let has_axis = !matches!(kind, JointKind::Fixed | JointKind::Floating);
        if has_axis && norm(axis) == 0.0 {
            let axis = child(node, "axis").unwrap_or(node);
            self.report(axis, Reason::NoAxis(name.to_owned()));
            return None;
        }
        Some(Joint {
            name: name.to_owned(),
            at: self.place(node),
            kind,
            parent: parent?,
            child: child_link?,
            pose: pose?,
            axis,
            mimic: mimic?,
            damping: damping?,
        })
    }

    fn kind(&mut self, node: Node, word: &str) -> Option<JointKind> {
        let entry = KINDS.iter().find(|(known, _)| *known == word);
        if entry.is_none() {
            let near = nearest(word, KINDS.map(|(known, _)| known));
            let near = KINDS.iter().map(|(known, _)| *known).find(|known| Some(*known) == near);
            let word = word.to_owned();
            self.report(node, Reason::JointType { found: word, near });
        }
        entry.map(|(_, kind)| *kind)
    }

    fn link_of(&mut self, node: Node<'a, 'a>, element: &'static str, joint: &str, links: &[Link]) -> Option<usize> {
        let end = self.needed(node, element, joint)?;
        let name = self.attribute(end, "link")?;
        let index = links.iter().position(|link| link.name == name);
        if index.is_none() {
            let near = nearest(name, links.iter().map(|link| link.name.as_str()));
            let reason = Reason::Unknown { what: "link", name: name.to_owned(), near: near.map(str::to_owned) };
            self.report(end, reason);
        }
        index
    }

    fn mimic(&mut self, node: Node<'a, 'a>, names: &[&str]) -> Option<Mimic> {
        let name = self.attribute(node, "joint");
        let ratio = self.number(node, "multiplier", 1.0);
        let offset = self.number(node, "offset", 0.0);
        let name = name?;
        let index = names.iter().position(|known| *known == name);
        if index.is_none() {
            let near = nearest(name, names.iter().copied());
            // A copied limb may have a prefix that its `mimic` lacks.
            let longer = || names.iter().copied().find(|known| known.ends_with(name));
            let reason =
                Reason::Unknown { what: "joint", name: name.to_owned(), near: near.or_else(longer).map(str::to_owned) };
            self.report(node, reason);
        }
        Some(Mimic { of: index?, ratio: ratio?, offset: offset? })
    }

    /// The viscous damping; dry friction is ignored.
    fn dynamics(&mut self, joint: Node<'a, 'a>, name: &str) -> Option<f64> {
        let Some(node) = child(joint, "dynamics") else {
            return Some(0.0);
        };
        let friction = self.number(node, "friction", 0.0);
        if friction.is_some_and(|friction| friction != 0.0) {
            let key = ("joints", "dynamics friction".to_owned());
            self.ignored.entry(key).or_default().push(name.to_owned());
        }
        self.number(node, "damping", 0.0)
    }

    /// Reads `xyz` and `rpy`: roll about x, pitch about y, yaw about z of the outer frame, or equivalently yaw first,
    /// each about the axes as turned.
    fn origin(&mut self, node: Node<'a, 'a>) -> Option<Pose> {
        let Some(origin) = child(node, "origin") else {
            return Some(Pose::default());
        };
        let offset = self.vector(origin, "xyz", [0.0; 3]);
        let turns = self.vector(origin, "rpy", [0.0; 3]);
        let [roll, pitch, yaw] = turns?;
        let rotations = [([0.0, 0.0, 1.0], yaw), ([0.0, 1.0, 0.0], pitch), ([1.0, 0.0, 0.0], roll)];
        Some(Pose { offset: offset?, rotations: rotations.into_iter().filter(|(_, angle)| *angle != 0.0).collect() })
    }

    fn vector(&mut self, node: Node, attribute: &'static str, default: Vector) -> Option<Vector> {
        let Some(text) = node.attribute(attribute) else {
            return Some(default);
        };
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(parsed).collect();
        let vector = numbers.and_then(|numbers| Vector::try_from(numbers).ok());
        if vector.is_none() {
            self.wrong_value(node, attribute, text, "three numbers");
        }
        vector
    }

    fn needed_number(&mut self, node: Node<'a, 'a>, attribute: &'static str) -> Option<f64> {
        self.attribute(node, attribute)?;
        self.number(node, attribute, 0.0)
    }

    fn number(&mut self, node: Node, attribute: &'static str, default: f64) -> Option<f64> {
        let Some(text) = node.attribute(attribute) else {
            return Some(default);
        };
        let number = parsed(text.trim());
        if number.is_none() {
            self.wrong_value(node, attribute, text, "a number");
        }
        number
    }

    fn wrong_value(&mut self, node: Node, attribute: &str, text: &str, expected: &'static str) {
        let text: String = text.chars().take(60).collect();
        let reason =
            Reason::Value { attribute: format!("{} {attribute}", node.tag_name().name()), found: text, expected };
        self.report(node, reason);
    }
}

/// A finite number.
fn parsed(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}
