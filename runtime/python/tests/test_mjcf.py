"""Models of other people's packages, translated from MuJoCo's files, against MuJoCo's own numbers.

Where MuJoCo or a package is absent, its tests say so.
"""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import eigentol

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is absent: no MJCF file is compared")


def folder(package, *inside):
    found = importlib.util.find_spec(package)
    return Path(found.origin).parent.joinpath(*inside) if found else None


FREE, BALL = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)
SOURCES = {
    "gymnasium": folder("gymnasium", "envs", "mujoco", "assets"),
    "dm_control": folder("dm_control", "suite"),
}
FILES = [
    path
    for source in SOURCES.values()
    if source is not None and source.is_dir()
    for path in sorted(source.glob("*.xml"))
]


def smooth(path):
    """MuJoCo's model without what is no part of a mechanism: contacts, limits, motors, friction, soft equalities."""
    spec = mujoco.MjSpec.from_file(str(path))
    model = spec.compile()
    flags = mujoco.mjtDisableBit
    for flag in (flags.mjDSBL_CONTACT, flags.mjDSBL_LIMIT, flags.mjDSBL_EQUALITY, flags.mjDSBL_ACTUATION, flags.mjDSBL_FRICTIONLOSS):
        model.opt.disableflags |= flag
    model.opt.density = model.opt.viscosity = 0.0
    model.opt.wind[:] = 0.0
    return model


def of_velocity(model):
    """The matrix that takes our rates at the reference to MuJoCo's velocities, and whether it holds everywhere."""
    matrix = np.eye(model.nv)
    simple = True
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    turns = np.fliplr(np.eye(3))
    for joint in range(model.njnt):
        at = model.jnt_dofadr[joint]
        kind = int(model.jnt_type[joint])
        if kind == FREE:
            own = data.xmat[model.jnt_bodyid[joint]].reshape(3, 3)
            matrix[at : at + 3, at : at + 3] = own
            matrix[at + 3 : at + 6, at + 3 : at + 6] = turns
        elif kind == BALL:
            matrix[at : at + 3, at : at + 3] = turns
        else:
            continue
        simple = False
    return matrix, simple


def theirs(model, x, v):
    """Mass matrix and forces that hold the state, springs and dampers among them."""
    data = mujoco.MjData(model)
    qpos = model.qpos0.copy()
    for joint in range(model.njnt):
        if int(model.jnt_type[joint]) not in (FREE, BALL):
            qpos[model.jnt_qposadr[joint]] += x[model.jnt_dofadr[joint]]
    data.qpos[:], data.qvel[:] = qpos, v
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, mass, data.qM) if hasattr(data, "qM") else mujoco.mj_fullM(model, data, mass)
    return mass, data.qfrc_bias - data.qfrc_passive


def slopes(function, n):
    """Central differences of sixth order."""
    h = 1e-2
    weights = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
    columns = []
    for step in np.eye(n):
        total = sum(w * (function(k * h * step) - function(-k * h * step)) for k, w in weights.items())
        columns.append(total / h)
    return np.array(columns).T


def close(a, b, tolerance):
    scale = max(np.abs(b).max(initial=0.0), 1e-9)
    assert np.abs(a - b).max(initial=0.0) <= tolerance * scale, np.abs(a - b).max() / scale


def compare(model, mechanism):
    n = model.nv
    assert len(mechanism.coordinates) == n
    matrix, simple = of_velocity(model)
    generator = np.random.default_rng(3)
    x = generator.uniform(-0.3, 0.3, n) if simple else np.zeros(n)
    v = generator.uniform(-1, 1, n) if simple else np.zeros(n)
    padded = lambda vector: np.concatenate([vector, np.zeros(len(mechanism.unknowns) - n)])
    mass, force = mechanism.mass_and_forces(padded(v), padded(x))
    their_mass, their_force = theirs(model, x, matrix @ v)
    close(mass[:n, :n], matrix.T @ their_mass @ matrix, 1e-10)
    close(-force[:n], matrix.T @ their_force, 1e-10)
    if simple and len(mechanism.unknowns) == n:
        _, damping, stiffness = mechanism.linear(x)
        at_rest = lambda dx: theirs(model, x + dx, np.zeros(n))[1]
        moving = lambda dv: theirs(model, x, dv)[1]
        # Differences of sixth order have errors of their own.
        close(stiffness, slopes(at_rest, n), 1e-9)
        close(damping, slopes(moving, n), 1e-9)


# What MuJoCo reads and a declaration cannot say, in words of the message.
REFUSED = {"lqr": "nothing moves"}


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_models_of_packages(path):
    if path.stem in REFUSED:
        with pytest.raises(eigentol.DeclarationError, match=REFUSED[path.stem]):
            eigentol.import_mjcf(path)
        return
    compare(smooth(path), eigentol.import_mjcf(path, resistance="none").mechanism())


def some(generator, low, high, count=1):
    return " ".join(f"{x:.4f}" for x in generator.uniform(low, high, count))


def turned(generator):
    """One of the ways to turn a frame, or none."""
    g = generator
    ways = ["", f'quat="{some(g, -1, 1, 4)}"', f'euler="{some(g, -90, 90, 3)}"', f'axisangle="{some(g, -1, 1, 3)} {some(g, -90, 90)}"',
            f'xyaxes="1 {some(g, -1, 1, 2)} {some(g, -1, 1)} 1 {some(g, -1, 1)}"', f'zaxis="{some(g, -1, 1, 3)}"']
    return ways[g.integers(len(ways))]


def random_model(seed):
    """A tree of random bodies with all that matters to their mass and their joints."""
    g = np.random.default_rng(seed)
    joints = []

    def geom():
        kind = ["sphere", "capsule", "cylinder", "box", "ellipsoid"][g.integers(5)]
        mass = [f'mass="{some(g, 0.1, 2)}"', f'density="{some(g, 100, 5000)}"', "", 'class="light"'][g.integers(4)]
        group = f'group="{g.integers(0, 5)}"' if g.random() < 0.3 else ""
        ends = kind in ("capsule", "cylinder", "box", "ellipsoid") and g.random() < 0.3
        frame = f'fromto="{some(g, -0.3, 0.3, 6)}"' if ends else f'pos="{some(g, -0.2, 0.2, 3)}" {turned(g)}'
        return f'<geom type="{kind}" size="{some(g, 0.05, 0.3, 3)}" {mass} {group} {frame}/>'

    def joint():
        name = f"j{len(joints)}"
        joints.append(name)
        text = f'<joint name="{name}" type="{["hinge", "slide"][g.integers(2)]}" axis="{some(g, -1, 1, 3)}" pos="{some(g, -0.2, 0.2, 3)}"'
        for attribute, low, high in [("stiffness", 0, 5), ("damping", 0, 2), ("armature", 0, 1), ("springref", -1, 1), ("ref", -1, 1)]:
            if g.random() < 0.5:
                text += f' {attribute}="{some(g, low, high)}"'
        return text + (' class="heavy"/>' if g.random() < 0.3 else "/>")

    def body(depth):
        text = f'<body pos="{some(g, -0.5, 0.5, 3)}" {turned(g)}' + (' childclass="heavy">' if g.random() < 0.3 else ">")
        text += "".join(joint() for _ in range(g.integers(0 if depth else 1, 3)))
        if g.random() < 0.2:
            m = g.uniform(0.1, 2)
            text += f'<inertial pos="{some(g, -0.2, 0.2, 3)}" mass="{m:.4f}" fullinertia="0.3 0.25 0.2 {some(g, -0.05, 0.05, 3)}"/>'
        else:
            text += "".join(geom() for _ in range(g.integers(1, 4)))
        if depth < 3:
            text += "".join(body(depth + 1) for _ in range(g.integers(0, 3)))
        return text + "</body>"

    world = "".join(body(0) for _ in range(g.integers(1, 3)))
    tendon = ""
    if len(joints) > 1:
        two = g.choice(joints, 2, replace=False)
        length = ["", f'springlength="{some(g, -1, 1)}"' , 'springlength="0.3"'][g.integers(3)]
        parts = "".join(f'<joint joint="{name}" coef="{some(g, -2, 2)}"/>' for name in two)
        tendon = f'<tendon><fixed name="t" stiffness="{some(g, 0, 5)}" damping="{some(g, 0, 2)}" {length}>{parts}</fixed></tendon>'
    order = ["xyz", "ZYX", "zxz", "XYZ"][g.integers(4)]
    total = 'settotalmass="7"' if g.random() < 0.2 else ""
    return f"""<mujoco model="random"><compiler eulerseq="{order}" {total} inertiagrouprange="0 3"/>
        <option gravity="{some(g, -9, 9, 3)}"/>
        <default><geom density="700"/><joint damping="0.3"/>
            <default class="light"><geom density="90"/><default class="heavy"><joint armature="0.4" stiffness="1.5"/></default></default></default>
        <worldbody>{world}</worldbody>{tendon}</mujoco>"""


@pytest.mark.parametrize("seed", range(60))
def test_random_models(seed, tmp_path):
    path = tmp_path / "random.xml"
    path.write_text(random_model(seed))
    try:
        model = smooth(path)
    except ValueError as error:
        # All geoms of a body are in groups that do not count.
        assert "mass and inertia" in str(error)
        return
    compare(model, eigentol.import_mjcf(path, resistance="none").mechanism())


def test_meshes(tmp_path):
    """A hollow mesh, with a scale and a frame of its own, from all kinds of files and with both volumes."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.3], [0.5, 0.5, 1.2]]) * 0.2
    faces = [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4], [0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 0, 5]]
    corners = np.array([[points[k] for k in face] for face in faces], dtype="<f4")
    stl = b" " * 80 + np.uint32(len(faces)).tobytes()
    stl += b"".join(np.zeros(3, "<f4").tobytes() + three.tobytes() + b"\0\0" for three in corners)
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "tent.stl").write_bytes(stl)
    obj = "".join(f"v {x} {y} {z}\n" for x, y, z in points) + "".join("f " + " ".join(f"{k + 1}//1" for k in face) + "\n" for face in faces)
    (tmp_path / "meshes" / "tent2.obj").write_text("vn 0 0 1\n" + obj)
    inline = f'vertex="{" ".join(map(str, points.ravel()))}" face="{" ".join(str(k) for face in faces for k in face)}"'
    for k, (mesh, name) in enumerate([
        ('file="tent.stl" inertia="legacy"', "tent"), ('file="tent.stl"', "tent"), ('file="tent.stl" scale="1 2 0.5" inertia="exact"', "tent"), ('file="tent2.obj" inertia="exact"', "tent2"),
        (f'name="own" {inline} refpos="0.1 0.2 0.1" refquat="0.5 0.1 0.2 0.4"', "own"), (f'name="own" {inline} inertia="exact"', "own"),
    ]):
        path = tmp_path / f"mesh{k}.xml"
        path.write_text(f"""<mujoco><compiler meshdir="meshes"/><asset><mesh {mesh}/></asset><worldbody><body pos="0.1 0.2 0.3">
            <joint name="a" axis="0.3 1 0.2" pos="0.1 0 0"/><joint name="b" axis="1 0 0"/><joint name="c" axis="0 0.2 1"/>
            <geom type="mesh" mesh="{name}" density="800" pos="0.1 0 0.2" euler="20 30 40"/></body></worldbody></mujoco>""")
        compare(smooth(path), eigentol.import_mjcf(path).mechanism())


JOINED = """<mujoco model="joined"><compiler angle="radian"/><include file="parts/defaults.xml"/>
  <worldbody>
    <body name="crank" pos="0 0 1"><joint name="a" axis="0 1 0" damping="0.1"/><geom type="capsule" size="0.02" fromto="0 0 0 0.3 0 0" mass="1"/>
      <body name="rod" pos="0.3 0 0"><joint name="b" axis="0 1 0"/><geom type="capsule" size="0.02" fromto="0 0 0 0.8 0 0.4" mass="1"/></body>
    </body>
    <body name="rocker" pos="1.1 0 0.6"><joint name="c" axis="0 1 0" stiffness="40"/><geom type="capsule" size="0.02" fromto="0 0 0 0 0 0.8" mass="2"/></body>
    <body name="cam" pos="2 0 0"><joint name="d" axis="0 1 0" stiffness="3" ref="0.2"/><geom type="box" size="0.1 0.1 0.2" mass="1"/></body>
    <body name="follower" pos="2 0 1"><joint name="e" type="slide" axis="0 0 1" ref="0.1"/><geom type="sphere" size="0.1" mass="0.5"/></body>
    <body name="loose" pos="3 0 1" euler="0 0.3 0"><freejoint/><geom type="box" size="0.1 0.2 0.1" mass="1"/></body>
  </worldbody>
  <equality>
    <connect body1="rod" body2="rocker" anchor="0.8 0 0.4"/>
    <joint joint1="e" joint2="d" polycoef="0.05 0.3 0.2 0 0"/>
    WELD
  </equality></mujoco>"""


WELDS = [
    '<weld body1="crank" body2="loose"/>',
    '<weld body1="crank" body2="loose" relpose="0.4 0.1 0.2 0.9 0.1 0.3 0.2"/>',
    '<weld body1="crank" body2="loose" relpose="0.4 0.1 0.2 0.9 0.1 0.3 0.2" anchor="0.1 0.2 0.3"/>',
    '<weld site1="on_crank" site2="on_loose"/>',
    '<weld body1="loose"/>',
]


@pytest.mark.parametrize("weld", WELDS)
def test_equalities(tmp_path, weld):
    """At our equilibrium MuJoCo's equalities are met, and its forces are balanced by their reactions."""
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "defaults.xml").write_text("<mujoco><default><geom density='500'/></default></mujoco>")
    path = tmp_path / "joined.xml"
    sites = '<site name="on_{0}" pos="0.1 0 0.2" euler="0.2 0.3 0.4"/></body>'
    text = JOINED.replace("WELD", weld).replace('size="0.1 0.2 0.1" mass="1"/></body>', 'size="0.1 0.2 0.1" mass="1"/>' + sites.format("loose"))
    path.write_text(text.replace('mass="1"/></body>\n    </body>', 'mass="1"/></body>' + sites.format("crank").replace("</body>", "") + "\n    </body>"))
    imported = eigentol.import_mjcf(path)
    study = eigentol.Study(imported.mechanism())
    state = study.equilibrium()
    values = dict(zip(study.mechanism.unknowns, state.coordinates))
    model = mujoco.MjSpec.from_file(str(path)).compile()
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    data = mujoco.MjData(model)
    for joint in range(model.njnt):
        kind, at = int(model.jnt_type[joint]), model.jnt_qposadr[joint]
        if kind != FREE:
            data.qpos[at] += values[model.joint(joint).name]
    # Our coordinates of the loose body are along its axes at the reference.
    start = mujoco.MjData(model)
    mujoco.mj_kinematics(model, start)
    loose = start.body("loose")
    first = loose.xmat.reshape(3, 3)
    own = next(name.removesuffix("_px") for name in values if name.endswith("_px"))
    at = model.jnt_qposadr[model.njnt - 1]
    data.qpos[at : at + 3] = loose.xpos + first @ [values[f"{own}_p{axis}"] for axis in "xyz"]
    turn = first
    for ending, axis in (("yaw", [0, 0, 1]), ("pitch", [0, 1, 0]), ("roll", [1, 0, 0])):
        quaternion, matrix = np.zeros(4), np.zeros(9)
        mujoco.mju_axisAngle2Quat(quaternion, np.array(axis, float), values[f"{own}_{ending}"])
        mujoco.mju_quat2Mat(matrix, quaternion)
        turn = turn @ matrix.reshape(3, 3)
    mujoco.mju_mat2Quat(quaternion, turn.ravel())
    data.qpos[at + 3 : at + 7] = quaternion
    mujoco.mj_forward(model, data)
    rows = data.nefc
    assert rows >= 3 + 1 + 6 and np.abs(data.efc_pos[:rows]).max() < 1e-9
    jacobian = np.array(data.efc_J[: rows * model.nv]).reshape(rows, model.nv)
    force = data.qfrc_bias - data.qfrc_passive
    reactions = np.linalg.lstsq(jacobian.T, force, rcond=None)[0]
    assert np.abs(jacobian.T @ reactions - force).max() < 1e-8 * np.abs(force).max()
