//! Assembles the named bodies, joints and points of the declaration, with notes on everything that was changed or left
//! out.

use eigentol_compiler::model::inertia::{is_inertia_of_a_body, nearest_of_a_body, principal};

use crate::error::{ImportError, Mistake, Reason};
use crate::geometry::{Matrix, Moments, Pose, Vector, cross, norm};
use crate::names::{Names, type_name};
use crate::note::Note;
use crate::options::{Base, Options, Resistance};
use crate::robot::{Joint, JointKind, Robot};
use crate::weld::Tree;

pub(crate) const GROUND: &str = "ground";

/// The content of the declaration.
#[derive(Clone, Debug)]
pub(crate) struct Assembly {
    pub(crate) robot: String,
    pub(crate) name: String,
    pub(crate) bodies: Vec<Body>,
    pub(crate) joints: Vec<Moving>,
    pub(crate) points: Vec<Point>,
    pub(crate) couplings: Vec<Coupling>,
    pub(crate) dampers: Vec<Damper>,
    pub(crate) resistance: Resistance,
    pub(crate) names: Names,
    pub(crate) notes: Vec<Note>,
}

#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) mass: Option<Mass>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Mass {
    pub(crate) mass: f64,
    pub(crate) center: Vector,
    pub(crate) inertia: Matrix,
}

#[derive(Clone, Debug)]
pub(crate) struct Moving {
    pub(crate) name: String,
    pub(crate) kind: &'static str,
    pub(crate) coordinates: Vec<Coordinate>,
    pub(crate) from: String,
    pub(crate) to: String,
    pub(crate) pose: Pose,
}

#[derive(Clone, Debug)]
pub(crate) struct Coordinate {
    pub(crate) name: String,
    pub(crate) axis: Vector,
    pub(crate) is_angle: bool,
    pub(crate) driven: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) name: String,
    pub(crate) body: String,
    pub(crate) pose: Pose,
}

#[derive(Clone, Debug)]
pub(crate) struct Coupling {
    pub(crate) name: String,
    /// Name of the coordinate, and whether it is an angle.
    pub(crate) of: (String, bool),
    pub(crate) with: (String, bool),
    pub(crate) ratio: f64,
    pub(crate) offset: f64,
}

#[derive(Clone, Debug)]
pub(crate) struct Damper {
    pub(crate) name: String,
    pub(crate) on: String,
    pub(crate) is_angle: bool,
    pub(crate) damping: f64,
}

const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];

/// Assembles the content of the declaration from a robot.
pub(crate) fn assemble(robot: &Robot, tree: &Tree, options: &Options) -> Result<Assembly, ImportError> {
    let mut names = Names::default();
    // Results are identified by coordinate, so joints get first choice of their names.
    let joints = tree.moving.iter().map(|&index| {
        let joint = &robot.joints[index];
        (index, names.of_file(&joint.name, "joint"))
    });
    let joint_names: Vec<(usize, String)> = joints.collect();
    let base = base_joint(options.base, &mut names);
    let body_names: Vec<String> = tree
        .groups
        .iter()
        .enumerate()
        .map(|(group, links)| match (group, options.base) {
            (0, Base::Fixed) => GROUND.to_owned(),
            _ => names.of_file(&robot.links[links[0]].name, "link"),
        })
        .collect();
    let mut notes = ignored(robot);
    let bodies = bodies(robot, tree, options, &body_names, &mut notes)?;
    let mut moving: Vec<Moving> = Vec::new();
    if let Some((name, kind, coordinates)) = base {
        moving.push(Moving {
            name,
            kind,
            coordinates,
            from: GROUND.to_owned(),
            to: body_names[0].clone(),
            pose: Pose::default(),
        });
    }
    for (number, (index, name)) in joint_names.iter().enumerate() {
        let joint = &robot.joints[*index];
        let (group, pose) = &tree.place[joint.parent];
        moving.push(Moving {
            name: name.clone(),
            kind: kind(joint.kind),
            coordinates: coordinates(joint, name, &mut names),
            from: body_names[*group].clone(),
            to: body_names[number + 1].clone(),
            pose: pose.then(&joint.pose),
        });
    }
    if moving.is_empty() {
        let reason = Reason::NothingMoves("every joint is fixed");
        return Err(alone(robot.at.mistake(reason)));
    }
    let points = points(robot, tree, &body_names, options.base, &mut names, &mut notes);
    let couplings = couplings(robot, &joint_names, &mut names);
    if options.resistance != Resistance::KernelsOnly {
        drive_what_moves_no_mass(&mut moving, &bodies, &couplings, &mut notes);
        let mut free = moving.iter().flat_map(|joint| &joint.coordinates);
        if free.all(|coordinate| coordinate.driven) {
            let reason = Reason::NothingMoves("no joint carries a link with a mass");
            return Err(alone(robot.at.mistake(reason)));
        }
    }
    let dampers = if options.damping { dampers(robot, &joint_names, &moving, &mut names) } else { Vec::new() };
    for joint in tree.held.iter().map(|&index| robot.joints[index].name.clone()) {
        notes.push(Note::Held { joint });
    }
    for joint in robot.joints.iter().filter(|joint| joint.kind == JointKind::Fixed && joint.mimic.is_some()) {
        let joint = joint.name.clone();
        notes.push(Note::FixedMimic { joint });
    }
    Ok(Assembly {
        robot: robot.name.clone(),
        name: options.name.clone().unwrap_or_else(|| type_name(&robot.name)),
        bodies,
        joints: moving,
        points,
        couplings,
        dampers,
        resistance: options.resistance,
        names,
        notes,
    })
}

fn alone(mistake: Mistake) -> ImportError {
    ImportError { mistakes: vec![mistake] }
}

fn ignored(robot: &Robot) -> Vec<Note> {
    let notes = robot.ignored.iter().map(|((of, element), names)| Note::Ignored {
        element: element.clone(),
        of,
        names: names.clone(),
    });
    notes.collect()
}

fn coordinate(name: String, axis: Vector, is_angle: bool) -> Coordinate {
    Coordinate { name, axis, is_angle, driven: false }
}

type BaseJoint = (String, &'static str, Vec<Coordinate>);

fn base_joint(base: Base, names: &mut Names) -> Option<BaseJoint> {
    let (kind, motions) = match base {
        Base::Fixed => return None,
        Base::Floating => ("free", floating()),
        Base::Planar => ("planar", in_plane(Z)),
    };
    let name = names.unique("base_joint", "joint");
    Some((name, kind, named(&motions, "base", names)))
}

/// Suffix of the name, axis, and whether it is an angle.
type Motion = (&'static str, Vector, bool);

fn floating() -> Vec<Motion> {
    vec![("px", X, false), ("py", Y, false), ("pz", Z, false), ("yaw", Z, true), ("pitch", Y, true), ("roll", X, true)]
}

/// Two displacements perpendicular to a normal, and the turn about it.
fn in_plane(normal: Vector) -> Vec<Motion> {
    let unit = |v: Vector| v.map(|x| x / norm(v));
    let normal = unit(normal);
    let across = [X, Y, Z][(0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs())).unwrap_or(0)];
    let second = unit(cross(normal, across));
    vec![("px", unit(cross(second, normal)), false), ("py", second, false), ("yaw", normal, true)]
}

fn named(motions: &[Motion], prefix: &str, names: &mut Names) -> Vec<Coordinate> {
    let coordinates = motions.iter().map(|&(ending, axis, is_angle)| {
        let name = names.unique(&format!("{prefix}_{ending}"), "coordinate");
        coordinate(name, axis, is_angle)
    });
    coordinates.collect()
}

fn kind(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Fixed => "fixed",
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
        JointKind::Planar => "planar",
        JointKind::Floating => "free",
    }
}

fn coordinates(joint: &Joint, name: &str, names: &mut Names) -> Vec<Coordinate> {
    match joint.kind {
        JointKind::Fixed => Vec::new(),
        JointKind::Revolute => vec![coordinate(name.to_owned(), joint.axis, true)],
        JointKind::Prismatic => vec![coordinate(name.to_owned(), joint.axis, false)],
        JointKind::Planar => named(&in_plane(joint.axis), name, names),
        JointKind::Floating => named(&floating(), name, names),
    }
}

/// Every group except the ground, with the combined mass of its links.
fn bodies(
    robot: &Robot,
    tree: &Tree,
    options: &Options,
    names: &[String],
    notes: &mut Vec<Note>,
) -> Result<Vec<Body>, ImportError> {
    let mut mistakes = Vec::new();
    let mut bodies = Vec::new();
    for (links, name) in tree.groups.iter().zip(names) {
        if name == GROUND {
            continue;
        }
        let heavy: Vec<usize> = links.iter().copied().filter(|&link| is_heavy(robot, link)).collect();
        let total = mass(robot, tree, &heavy);
        match total.and_then(|mass| judged(robot, &heavy, mass, options, notes)) {
            Ok(mass) => bodies.push(Body { name: name.clone(), mass }),
            Err(reason) => {
                let first = heavy.first().unwrap_or(&links[0]);
                mistakes.push(robot.links[*first].at.mistake(reason));
            }
        }
    }
    if mistakes.is_empty() {
        return Ok(bodies);
    }
    mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
    Err(ImportError { mistakes })
}

/// Whether it has a mass or an inertia.
fn is_heavy(robot: &Robot, link: usize) -> bool {
    let inertial = robot.links[link].inertial.as_ref();
    inertial.is_some_and(|inertial| inertial.mass > 0.0 || inertial.inertia.iter().flatten().any(|entry| *entry != 0.0))
}

/// The combined mass of links, in the frame of their group.
fn mass(robot: &Robot, tree: &Tree, links: &[usize]) -> Result<Option<Mass>, Reason> {
    let inertials = links.iter().filter_map(|&link| {
        let inertial = robot.links[link].inertial.as_ref()?;
        Some((link, inertial))
    });
    let inertials: Vec<_> = inertials.collect();
    // A single link in its own axes keeps its digits.
    if let [(link, inertial)] = inertials[..]
        && tree.place[link].1 == Pose::default()
        && inertial.pose.rotations.is_empty()
        && inertial.mass > 0.0
    {
        return Ok(Some(Mass { mass: inertial.mass, center: inertial.pose.offset, inertia: inertial.inertia }));
    }
    let mut moments = Moments::default();
    for (link, inertial) in &inertials {
        moments.add(&Moments::of(inertial, &tree.place[*link].1));
    }
    match (moments.mass > 0.0, links) {
        (false, []) => Ok(None),
        (false, [link, ..]) => Err(Reason::InertiaWithoutMass(robot.links[*link].name.clone())),
        (true, _) => {
            let (center, inertia) = moments.central();
            Ok(Some(Mass { mass: moments.mass, center, inertia }))
        }
    }
}

/// The mass, if a body can have its inertia; otherwise with the nearest possible inertia, or a mistake.
fn judged(
    robot: &Robot,
    links: &[usize],
    mass: Option<Mass>,
    options: &Options,
    notes: &mut Vec<Note>,
) -> Result<Option<Mass>, Reason> {
    let Some(mut given) = mass.filter(|mass| !is_inertia_of_a_body(&mass.inertia)) else {
        return Ok(mass);
    };
    let links = links.iter().map(|&link| robot.links[link].name.clone()).collect();
    let inertia = nearest_of_a_body(&given.inertia);
    let (before, after) = (principal(&given.inertia).0, principal(&inertia).0);
    if !options.nearest_inertias {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia;
        return Err(Reason::Inertia {
            links,
            principal: before,
            nearest: after,
            replacement: [xx, yy, zz, xy, yz, xz],
        });
    }
    notes.push(Note::Replaced { links, principal: before, nearest: after });
    given.inertia = inertia;
    Ok(Some(given))
}

/// The points for links that are not bodies, with their axes.
fn points(
    robot: &Robot,
    tree: &Tree,
    body_names: &[String],
    base: Base,
    names: &mut Names,
    notes: &mut Vec<Note>,
) -> Vec<Point> {
    let mut points = Vec::new();
    for (group, links) in tree.groups.iter().enumerate() {
        let is_ground = group == 0 && base == Base::Fixed;
        let welded = &links[if is_ground { 0 } else { 1 }..];
        for &link in welded {
            points.push(Point {
                name: names.of_file(&robot.links[link].name, "link"),
                body: body_names[group].clone(),
                pose: tree.place[link].1.clone(),
            });
        }
        if !welded.is_empty() {
            notes.push(Note::Welded {
                body: body_names[group].clone(),
                links: welded.iter().map(|&link| robot.links[link].name.clone()).collect(),
            });
        }
    }
    points
}

fn couplings(robot: &Robot, joints: &[(usize, String)], names: &mut Names) -> Vec<Coupling> {
    let named = |index: usize| {
        let (_, name) = joints.iter().find(|(joint, _)| *joint == index)?;
        Some((name.clone(), robot.joints[index].kind == JointKind::Revolute))
    };
    let mut couplings = Vec::new();
    for (index, name) in joints {
        if let Some(mimic) = robot.joints[*index].mimic
            && let (Some(of), Some(with)) = (named(*index), named(mimic.of))
        {
            couplings.push(Coupling {
                name: names.unique(&format!("coupling_of_{name}"), "constraint"),
                of,
                with,
                ratio: mimic.ratio,
                offset: mimic.offset,
            });
        }
    }
    couplings
}

fn dampers(robot: &Robot, joints: &[(usize, String)], moving: &[Moving], names: &mut Names) -> Vec<Damper> {
    let mut dampers = Vec::new();
    for (index, name) in joints {
        let joint = &robot.joints[*index];
        let mut all = moving.iter().flat_map(|joint| &joint.coordinates);
        let is_free = all.any(|coordinate| coordinate.name == *name && !coordinate.driven);
        if joint.kind.has_one_coordinate() && joint.damping != 0.0 && is_free {
            dampers.push(Damper {
                name: names.unique(&format!("damping_of_{name}"), "force"),
                on: name.clone(),
                is_angle: joint.kind == JointKind::Revolute,
                damping: joint.damping,
            });
        }
    }
    dampers
}

/// Drives joints that carry no mass, because no equation determines their motion. Exceptions are joints that follow
/// another, and joints followed by one that carries mass.
fn drive_what_moves_no_mass(joints: &mut [Moving], bodies: &[Body], couplings: &[Coupling], notes: &mut Vec<Note>) {
    let mut heavy: Vec<String> = Vec::new();
    for body in bodies.iter().filter(|body| body.mass.is_some()) {
        heavy.push(body.name.clone());
    }
    // Children come after their parents.
    for joint in joints.iter().rev() {
        if heavy.contains(&joint.to) {
            heavy.push(joint.from.clone());
        }
    }
    let light = joints.iter().filter(|joint| !heavy.contains(&joint.to));
    let light = light.flat_map(|joint| &joint.coordinates);
    let light: Vec<String> = light.map(|coordinate| coordinate.name.clone()).collect();
    for coordinate in joints.iter_mut().flat_map(|joint| &mut joint.coordinates) {
        let name = &coordinate.name;
        let follows = couplings.iter().any(|one| one.of.0 == *name);
        if light.contains(name) && !follows && lead_by(name, couplings).all(|one| light.contains(one)) {
            coordinate.driven = true;
            notes.push(Note::Driven { coordinate: coordinate.name.clone(), why: "it moves no mass" });
        }
    }
}

/// The coordinates that follow a given one, directly or through others.
fn lead_by<'a>(leader: &str, couplings: &'a [Coupling]) -> impl Iterator<Item = &'a String> {
    let mut followers: Vec<&String> = Vec::new();
    loop {
        let next = couplings.iter().find(|one| {
            let leads = one.with.0 == leader || followers.contains(&&one.with.0);
            leads && !followers.contains(&&one.of.0)
        });
        match next {
            Some(one) => followers.push(&one.of.0),
            None => return followers.into_iter(),
        }
    }
}
