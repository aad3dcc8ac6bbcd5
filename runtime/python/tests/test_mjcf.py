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
# What cannot be translated, and the words that say so.
REFUSED = {
    "dog": "mesh",
    "fish": None,
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


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_models_of_packages(path):
    try:
        model = smooth(path)
    except Exception as error:
        pytest.skip(f"MuJoCo refuses it: {error}")
    try:
        imported = eigentol.import_mjcf(path, resistance="none")
    except eigentol.DeclarationError as error:
        pytest.skip(f"refused: {error}")
    mechanism = imported.mechanism()
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
        close(stiffness, slopes(at_rest, n), 1e-9)
        close(damping, slopes(moving, n), 1e-9)
