"""Which equilibrium is meant: unstable ones, members of families, and places along free directions."""

import math

import numpy as np
import pytest

import eigentol

G, LENGTH = 9.81, 1.0

ROD = """mechanism Rod {
    design l = 1 m +/- 1%;
    gravity 9.81 m/s^2 along -z;
    body rod: rod(mass: 3 kg, length: l, along: -z);
    joint theta: revolute(y) from ground to rod;
}"""

COIN = """mechanism Coin {
    design r = 50 cm +/- 1%;
    gravity 9.81 m/s^2 along -z;
    body base: massless; body mast: massless; body fork: massless;
    body wheel: disk(mass: 1 kg, radius: r, axis: y);
    joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
    joint height: prismatic(z) from base to mast;
    joint lean: revolute(x) from mast to fork;
    joint spin: revolute(y) from fork to wheel, coasting;
    point hub: wheel; point road: ground;
    constraint contact: rolling(wheel: hub, axis: y, radius: r, on: road);
}"""

TRAIN = """mechanism Train {
    design k = 2000 N*m/rad +/- 5%;
    body a: rigid(mass: 1 kg, inertia: [1, 1, 2] kg*m^2);
    body b: rigid(mass: 1 kg, inertia: [2, 2, 3] kg*m^2);
    joint turn: revolute(z) from ground to a;
    joint twist: revolute(z) from a to b;
    force shaft: spring(on: twist, stiffness: k);
}"""


def rod(**settings):
    return eigentol.Study(eigentol.Mechanism.from_text(ROD), **settings)


def test_a_named_unstable_equilibrium_stays():
    study = rod(start={"theta": math.pi})
    state = study.equilibrium()
    assert state.stability.startswith("divergent") and not state.stable
    np.testing.assert_allclose(state.coordinates, [math.pi], rtol=1e-12)
    assert any("unstable" in note for note in state.notes)
    growth = math.sqrt(1.5 * G / LENGTH)
    modes = study.modes()
    np.testing.assert_allclose(max(modes.eigenvalues.real), growth, rtol=1e-12)


def test_the_nearest_equilibrium_whatever_its_stability():
    state = rod(start={"theta": 3.0}, stay=True).equilibrium()
    np.testing.assert_allclose(state.coordinates, [math.pi], rtol=1e-12)
    assert rod(guess={"theta": 3.0}).equilibrium().stable


def test_found_equilibria_can_be_asked_about():
    study = rod()
    found = study.equilibria(bounds={"theta": (-4.0, 4.0)})
    assert sorted(state.stable for state in found) == [False, True]
    unstable = next(state for state in found if not state.stable)
    again = rod(at=unstable).equilibrium()
    np.testing.assert_allclose(again.coordinates, unstable.coordinates, rtol=1e-12)


def test_unnamed_coordinates_are_not_bounded_to_zero():
    study = eigentol.Study(
        eigentol.Mechanism.from_text(
            "mechanism Two { body a: point(mass: 1 kg); body b: massless;"
            " joint x: prismatic(x) from ground to b; joint y: prismatic(y) from b to a;"
            " force s: potential(energy: (1 N/m^3) * ((x - 2 m)^2 * (x + 1 m)^2) + (1 N/m) * y^2); }"
        )
    )
    with pytest.raises(eigentol.InvalidValue, match="bounds"):
        study.equilibria(bounds={"y": (-1.0, 1.0)})
    found = study.equilibria(bounds={"x": (-3.0, 3.0), "y": (-1.0, 1.0)}, starts=20)
    places = sorted(state.coordinates[0] for state in found if state.stable)
    np.testing.assert_allclose(places, [-1.0, 2.0], atol=1e-7)


def test_held_unknowns_pick_the_member_of_a_family():
    coin = eigentol.Mechanism.from_text(COIN)
    study = eigentol.Study(
        coin, guess={"height": 0.5}, hold={"lean": "20 deg", "yaw": "-1.2 rad/s"}
    )
    state = study.equilibrium()
    assert state.held == pytest.approx({"lean": math.radians(20), "yaw": -1.2}, rel=1e-12)
    assert state.free.shape == (2, len(state.names))
    assert any("family" in note for note in state.notes)


def test_a_free_direction_is_a_mode_of_frequency_zero():
    train = eigentol.Study(eigentol.Mechanism.from_text(TRAIN))
    modes = train.modes()
    exact = math.sqrt(2000 * (1 / 2 + 1 / 3))
    np.testing.assert_allclose(np.sort(np.abs(modes.eigenvalues.imag))[-1], exact, rtol=1e-12)
    state = train.equilibrium()
    np.testing.assert_allclose(state.stiffness @ state.free.T, 0.0, atol=1e-9)
    spread = train.first_order()
    assert np.isfinite(spread["sigma of frequency"][-1]) and set(spread["doubts"]) == {None}
