//! Combines links that are welded together by fixed joints into one body.

use crate::error::{ImportError, Mistake, Reason};
use crate::geometry::Pose;
use crate::robot::{JointKind, Robot};

/// The tree of a robot's links.
pub(crate) struct Tree {
    /// By link: its group, and its pose in the frame of the group's first link.
    pub(crate) place: Vec<(usize, Pose)>,
    /// The links of each group, starting with the one that its joint moves. Group 0 contains the root.
    pub(crate) groups: Vec<Vec<usize>>,
    /// Joints that move groups, parents first.
    pub(crate) moving: Vec<usize>,
    /// Joints that could move, but follow one that cannot, or follow with a multiplier of zero.
    pub(crate) held: Vec<usize>,
}

/// Finds the groups.
pub(crate) fn weld(robot: &Robot) -> Result<Tree, ImportError> {
    let joint_to = joints_to_links(robot)?;
    let root = root(robot, &joint_to)?;
    let held = held(robot)?;
    let mut tree = Tree {
        place: vec![(0, Pose::default()); robot.links.len()],
        groups: vec![vec![root]],
        moving: Vec::new(),
        held: Vec::new(),
    };
    let mut joints_from = vec![Vec::new(); robot.links.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        joints_from[joint.parent].push(index);
    }
    // A stack keeps the joints of a limb together, in the order of the file.
    let mut waiting: Vec<usize> = joints_from[root].iter().rev().copied().collect();
    while let Some(index) = waiting.pop() {
        let joint = &robot.joints[index];
        let (group, pose) = &tree.place[joint.parent];
        if let (true, held) = (joint.kind == JointKind::Fixed || held[index].is_some(), &held[index]) {
            let mut pose = pose.then(&joint.pose);
            if let Some(at) = held {
                pose = pose.then(&displaced(joint.kind, joint.axis, *at));
                tree.held.push(index);
            }
            let group = *group;
            tree.groups[group].push(joint.child);
            tree.place[joint.child] = (group, pose);
        } else {
            tree.place[joint.child] = (tree.groups.len(), Pose::default());
            tree.groups.push(vec![joint.child]);
            tree.moving.push(index);
        }
        waiting.extend(joints_from[joint.child].iter().rev());
    }
    Ok(tree)
}

/// Pose of the child of a joint with one coordinate.
fn displaced(kind: JointKind, axis: [f64; 3], at: f64) -> Pose {
    let length = crate::geometry::norm(axis);
    match kind {
        _ if at == 0.0 => Pose::default(),
        JointKind::Prismatic => Pose { offset: axis.map(|x| at * x / length), rotations: Vec::new() },
        _ => Pose { offset: [0.0; 3], rotations: vec![(axis, at)] },
    }
}

/// By link, the joint to its parent.
fn joints_to_links(robot: &Robot) -> Result<Vec<Option<usize>>, ImportError> {
    let mut joint_to: Vec<Option<usize>> = vec![None; robot.links.len()];
    let mut mistakes = Vec::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        match joint_to[joint.child] {
            None => joint_to[joint.child] = Some(index),
            Some(first) => mistakes.push(joint.at.mistake(Reason::TwoParents {
                link: robot.links[joint.child].name.clone(),
                first: robot.joints[first].name.clone(),
                second: joint.name.clone(),
            })),
        }
    }
    none_or(mistakes, joint_to)
}

/// The only link without a parent, from which all others descend.
fn root(robot: &Robot, joint_to: &[Option<usize>]) -> Result<usize, ImportError> {
    let name = |link: usize| robot.links[link].name.clone();
    let mut roots = (0..robot.links.len()).filter(|&link| joint_to[link].is_none());
    let Some(root) = roots.next() else {
        let reason = Reason::Circle(name(0));
        return Err(ImportError { mistakes: vec![robot.links[0].at.mistake(reason)] });
    };
    let mut mistakes: Vec<Mistake> = roots
        .map(|link| {
            let (root, link_name) = (name(root), name(link));
            robot.links[link].at.mistake(Reason::TwoRoots { root, link: link_name })
        })
        .collect();
    // A link reaches the root in at most as many steps as there are links, or never.
    let in_circle = (0..robot.links.len()).find(|&link| {
        let mut at = link;
        (0..robot.links.len()).all(|_| match joint_to[at] {
            Some(joint) => {
                at = robot.joints[joint].parent;
                true
            }
            None => false,
        })
    });
    mistakes.extend(in_circle.map(|link| robot.links[link].at.mistake(Reason::Circle(name(link)))));
    none_or(mistakes, root)
}

/// By joint, the coordinate at which it is held, because its leader cannot move or its multiplier is zero.
fn held(robot: &Robot) -> Result<Vec<Option<f64>>, ImportError> {
    let mut mistakes = Vec::new();
    let mut held = vec![None; robot.joints.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = joint.mimic.filter(|_| joint.kind != JointKind::Fixed) else {
            continue;
        };
        let leader = &robot.joints[mimic.of];
        let several = [joint, leader].iter().any(|one| matches!(one.kind, JointKind::Planar | JointKind::Floating));
        let why = if several {
            Some("one of them has several coordinates")
        } else if follows_itself(robot, index) {
            Some("it would follow itself")
        } else {
            None
        };
        match why {
            Some(why) => mistakes.push(joint.at.mistake(Reason::Mimic {
                joint: joint.name.clone(),
                of: leader.name.clone(),
                why,
            })),
            None => held[index] = stands_at(robot, index),
        }
    }
    none_or(mistakes, held)
}

fn follows_itself(robot: &Robot, joint: usize) -> bool {
    let mut at = joint;
    for _ in 0..=robot.joints.len() {
        match robot.joints[at].mimic {
            Some(mimic) if robot.joints[at].kind != JointKind::Fixed => at = mimic.of,
            _ => return false,
        }
    }
    true
}

/// The coordinate of a joint that cannot move.
fn stands_at(robot: &Robot, joint: usize) -> Option<f64> {
    let joint = &robot.joints[joint];
    match (joint.kind, joint.mimic) {
        (JointKind::Fixed, _) => Some(0.0),
        (_, Some(mimic)) if mimic.ratio == 0.0 => Some(mimic.offset),
        (_, Some(mimic)) => {
            let leader = stands_at(robot, mimic.of)?;
            Some(mimic.ratio * leader + mimic.offset)
        }
        (_, None) => None,
    }
}

fn none_or<T>(mistakes: Vec<Mistake>, value: T) -> Result<T, ImportError> {
    if mistakes.is_empty() { Ok(value) } else { Err(ImportError { mistakes }) }
}
