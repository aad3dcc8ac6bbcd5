"""Numbers of Pinocchio for robots of URDF files.

Reads from standard input a list of {"file", "floating", "coordinates", "points"}: the coordinates that are free, by the names of
their joints in the file (`base_px` and so on of a floating base); all others stay at zero. `points` are names of links. Writes the
list with "states" to standard output; fields as in ../robots, all in SI, with springs of 50 and dampers of 0.5 on every coordinate.
Of a robot with "nearest": true, inertias that no body has are replaced by the nearest possible ones; "replaced" has their joints.
"""

import json
import sys
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin

STIFFNESS, DAMPING, STATES = 50.0, 0.5, 3
BASE = [
    ("base_px", "prismatic", "1 0 0"),
    ("base_py", "prismatic", "0 1 0"),
    ("base_pz", "prismatic", "0 0 1"),
    ("base_yaw", "continuous", "0 0 1"),
    ("base_pitch", "continuous", "0 1 0"),
    ("base_roll", "continuous", "1 0 0"),
]


def on_six_joints(text):
    """The robot on joints of one coordinate each: derivatives of Pinocchio take no composite joint."""
    robot = ElementTree.fromstring(text)
    children = {joint.find("child").get("link") for joint in robot.findall("joint")}
    (root,) = [link.get("name") for link in robot.findall("link") if link.get("name") not in children]
    links = ["the_ground"] + [f"after_{name}" for name, _, _ in BASE[:-1]]
    for (name, kind, axis), parent, child in zip(BASE, links, links[1:] + [root]):
        ElementTree.SubElement(robot, "link", name=parent)
        joint = ElementTree.SubElement(robot, "joint", name=name, type=kind)
        ElementTree.SubElement(joint, "parent", link=parent)
        ElementTree.SubElement(joint, "child", link=child)
        ElementTree.SubElement(joint, "axis", xyz=axis)
        ElementTree.SubElement(joint, "limit", effort="0", velocity="0", lower="-9", upper="9")
    return ElementTree.tostring(robot, encoding="unicode")


def columns(model):
    """Name of each velocity."""
    names = [None] * model.nv
    for joint, name in list(zip(model.joints, model.names))[1:]:
        names[joint.idx_v] = name
    return names


def configuration(model, angles):
    """Coordinates of Pinocchio: a continuous joint has a cosine and a sine."""
    q = pin.neutral(model)
    for joint in list(model.joints)[1:]:
        own = angles[joint.idx_v : joint.idx_v + joint.nv]
        q[joint.idx_q : joint.idx_q + joint.nq] = own if joint.nq == joint.nv else [np.cos(own[0]), np.sin(own[0])]
    return q


def nearest_moments(given):
    """The nearest moments of which none exceeds the sum of the others: Dykstra's projections on three half-spaces."""
    normals = [np.array(n) / np.sqrt(3) for n in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
    x, corrections = np.array(given), [np.zeros(3) for _ in normals]
    for _ in range(10000):
        for k, normal in enumerate(normals):
            before = x + corrections[k]
            x = before - max(normal @ before, 0.0) * normal
            corrections[k] = before - x
    return x


def replace_inertias(model):
    """Of each joint, where all links that are welded together count as one body."""
    replaced = []
    for joint in range(1, model.njoints):
        own = model.inertias[joint]
        moments, axes = np.linalg.eigh(own.inertia)
        if 2 * moments.max() - moments.sum() > 2e-9 * moments.sum():
            nearest = axes @ np.diag(nearest_moments(moments)) @ axes.T
            model.inertias[joint] = pin.Inertia(own.mass, own.lever, nearest)
            replaced.append(model.names[joint])
    return replaced


def states(robot):
    with open(robot["file"]) as file:
        text = file.read()
    model = pin.buildModelFromXML(on_six_joints(text) if robot["floating"] else text)
    if robot.get("nearest"):
        robot["replaced"] = replace_inertias(model)
    data = model.createData()
    names = columns(model)
    place = [names.index(name) for name in robot["coordinates"]]
    random = np.random.default_rng(17)
    for _ in range(STATES):
        q, v, a, w = np.zeros((4, model.nv))
        for vector, size in ((q, 1.2), (v, 1.5), (a, 2.0), (w, 1.0)):
            vector[place] = random.uniform(-size, size, len(place))
        at = configuration(model, q)
        rest = pin.rnea(model, data, at, 0 * v, 0 * a).copy()
        tau = pin.rnea(model, data, at, v, a).copy()
        bias = pin.rnea(model, data, at, v, 0 * a).copy()
        dq, dv, mass = (np.array(x) for x in pin.computeRNEADerivatives(model, data, at, v, a))
        mass = np.triu(mass) + np.triu(mass, 1).T
        rest_dq = np.array(pin.computeRNEADerivatives(model, data, at, 0 * v, 0 * a)[0])
        pin.framesForwardKinematics(model, data, at)
        points = {name: list(data.oMf[model.getFrameId(name, pin.FrameType.BODY)].translation) for name in robot["points"]}
        spring, damper = STIFFNESS * q, DAMPING * v
        fields = {
            "q": q, "v": v, "a": a, "w": w,
            "tau_rest": rest + spring,
            "tau": tau + spring + damper,
            "bias": bias + spring + damper,
            "mass_w": mass @ w,
            "dq_w": dq @ w + STIFFNESS * w,
            "dv_w": dv @ w + DAMPING * w,
            "rest_dq_w": rest_dq @ w + STIFFNESS * w,
        }
        yield {**{key: list(value[place]) for key, value in fields.items()}, "points": points}


robots = json.load(sys.stdin)
for robot in robots:
    robot["pinocchio"] = pin.__version__
    robot["states"] = list(states(robot))
json.dump(robots, sys.stdout)
