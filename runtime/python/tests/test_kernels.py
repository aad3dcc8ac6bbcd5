"""Kernels against finite differences of each other, and their shapes."""

import numpy as np
import pytest

import eigentol

# Two unknowns, one input, three design variables: no shape is mistaken for another.
TEXT = """
mechanism Arm {
    input speed: rad/s;
    design l = 0.7 m +/- 2%;
    design m = 2 kg;
    design k = 30 N*m/rad +/- 5%;
    gravity 9.81 m/s^2 along -z;
    body shaft: massless;
    body upper: rod(mass: m, length: l, along: -z);
    body lower: rod(mass: 1.5 kg, length: 0.5 m, along: -z);
    joint spin: revolute(z) from ground to shaft, driven at speed;
    joint a: revolute(y) from shaft to upper;
    joint b: revolute(x) from upper to lower at [0, 0, -l];
    force elbow: spring(on: b, stiffness: k);
    force drag: damper(on: a, damping: 0.3 N*m*s/rad);
}
"""
Q, U, B = np.array([0.4, -0.3]), np.array([3.0]), np.array([0.7, 2.0, 30.0])
V, A = np.array([0.5, -0.8]), np.array([1.5, 0.6])


@pytest.fixture(scope="module")
def arm():
    return eigentol.Mechanism.from_text(TEXT)


def by_each(function, *arguments, step=1e-5):
    """Derivatives by the entries of every argument, along the last axis."""
    found = []
    for place, own in enumerate(arguments):
        columns = []
        for entry in range(len(own)):
            ends = []
            for side in (step, -step):
                moved = [np.array(one) for one in arguments]
                moved[place][entry] += side
                ends.append(np.asarray(function(*moved)))
            columns.append((ends[0] - ends[1]) / (2 * step))
        found.append(np.stack(columns, axis=-1))
    return found


def compare(found, expected):
    for own, other in zip(found, expected, strict=True):
        assert own.shape == other.shape
        np.testing.assert_allclose(own, other, rtol=1e-7, atol=1e-7)


def test_mode_gradient(arm):
    phi, eigenvalue = np.array([0.7, -0.2]), 11.0

    def form(*at):
        mass, _, stiffness = arm.linear(*at)
        return phi @ (stiffness - eigenvalue * mass) @ phi

    compare(arm.mode_gradient(phi, eigenvalue, Q, U, B), by_each(form, Q, U, B))


def test_residual_gradient(arm):
    w = np.array([0.3, 1.1])
    compare(arm.residual_gradient(w, Q, U, B), by_each(lambda *at: w @ arm.residual(*at), Q, U, B))


def test_pencil_gradient(arm):
    left, x = np.array([0.3, -0.9]), np.array([0.2, 0.5])

    def form(*at):
        mass, damping, stiffness = arm.linear(*at)
        return left @ (mass @ A + damping @ V + stiffness @ x)

    compare(arm.pencil_gradient(left, A, V, x, Q, U, B), by_each(form, Q, U, B))


def test_partials_have_their_variable_last(arm):
    of_matrices = zip(*(by_each(lambda *at, which=which: arm.linear(*at)[which], Q, U, B) for which in range(3)))
    for own, expected in zip(zip(*arm.linear_partials(Q, U, B)), of_matrices, strict=True):
        compare(own, expected)
    compare(arm.residual_partials(Q, U, B), by_each(arm.residual, Q, U, B)[1:])


def test_motion(arm):
    mass, forces = arm.mass_and_forces(V, Q, U, B)
    residual = arm.motion_residual(A, V, Q, U, B)
    np.testing.assert_allclose(residual, mass @ A - forces, rtol=1e-12, atol=1e-12)
    compare(arm.motion_linear(A, V, Q, U, B), by_each(lambda *at: arm.motion_residual(*at, U, B), A, V, Q))
    rest = np.zeros(2)
    np.testing.assert_allclose(arm.motion_residual(rest, rest, Q, U, B), arm.residual(Q, U, B), rtol=1e-12)


def test_names_stand_for_numbers(arm):
    found = arm.mode_gradient({"a": 0.7, "b": -0.2}, 11.0, {"a": 0.4, "b": -0.3}, {"speed": 3.0})
    compare(found, arm.mode_gradient([0.7, -0.2], 11.0, Q, U, B))
    with pytest.raises(eigentol.InvalidValue, match="2"):
        arm.residual_gradient([1.0], Q, U, B)
