"""Mechanisms that the tests share."""

from pathlib import Path

import pytest

import eigentol

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


@pytest.fixture
def pendulum():
    return eigentol.Mechanism.from_file(EXAMPLES / "rotating_pendulum.mechanism")


@pytest.fixture
def study(pendulum):
    return eigentol.Study(pendulum, inputs={"omega": 5.0}, start={"theta": 1.0})


@pytest.fixture
def rotor():
    """Jeffcott's rotor without gravity, which bends the shaft."""
    text = (EXAMPLES / "jeffcott_rotor.mechanism").read_text()
    gravity = "gravity 9.81 m/s^2 along -y;"
    assert gravity in text
    return eigentol.Mechanism.from_text(text.replace(gravity, ""))


@pytest.fixture
def oil_rotor():
    """A stiff rotor on two oil films."""
    return eigentol.Mechanism.from_file(EXAMPLES / "rotor_bearings.mechanism")


SWING = """
pub mechanism Swing {
    input speed: rpm;
    design l = 1000 mm +/- 30 mm;
    gravity 9.81 m/s^2 along -z;
    body shaft: massless;
    body bar: rod(mass: 3 kg, length: l, along: -z);
    joint spin: revolute(z) from ground to shaft, driven at speed;
    joint theta: revolute(y) from shaft to bar;
    output angle = theta;
}
"""

TWINS = """
mechanism Twins {
    design a = 100 N/m +/- 5%;
    design b = 100 N/m +/- 5%;
    body left: point(mass: 1 kg);
    body right: point(mass: 1 kg);
    joint x: prismatic(x) from ground to left;
    joint y: prismatic(y) from ground to right;
    force first: spring(on: x, stiffness: a);
    force second: spring(on: y, stiffness: b);
}
"""


CANTILEVER = """
mechanism Cantilever {
    body arm: beam(length: 1 m, along: x, up: z, bending_y: 5, stiffness_y: 10 N*m^2, mass_per_length: 1 kg/m);
    joint clamp: fixed from ground to arm;
}
"""


SHAKEN = """
mechanism Shaken {
    input speed: rpm;
    design mass = 2 kg +/- 5%;
    body block: point(mass: mass);
    joint x: prismatic(x) from ground to block;
    force shaft: spring(on: x, stiffness: 800 N/m);
    force oil: damper(on: x, damping: 5 N*s/m);
    force gust: harmonic(on: x, force: 3 N, frequency: speed);
    output place = x;
}
"""


@pytest.fixture(scope="session")
def results():
    """An object of each class of the module, and of each kind of answer, by the name of the class or the kind."""
    mechanism = eigentol.Mechanism.from_text(SWING)
    study = eigentol.Study(
        mechanism, inputs={"speed": "60 rpm"}, start={"theta": "1 rad"}, samples=64, keep_samples=True
    )
    twins = eigentol.Study(eigentol.Mechanism.from_text(TWINS))
    shaken = eigentol.Study(eigentol.Mechanism.from_text(SHAKEN), inputs={"speed": 19.0}, samples=64)
    cantilever = eigentol.Study(eigentol.Mechanism.from_text(CANTILEVER))
    speeds, frequency = [6.0, 6.1, 6.2], "frequency 1"
    wanted = ["frequency 1 >= 5.8 rad/s", "stable"]
    with pytest.raises(eigentol.DeclarationError) as caught:
        eigentol.Mechanism.from_text("mechanism Wrong { body }")
    objects = [
        mechanism,
        study,
        study.equilibrium(),
        study.assembly(),
        study.equilibrium_shift(),
        study.modes(),
        cantilever.converge(),
        study.sensitivities(),
        study.shape_sensitivity(0),
        study.mode_curvature(0),
        study.output_curvature("angle"),
        study.critical_curvature("speed", 2.0, 6.0),
        study.outputs(),
        shaken.forced_response(),
        shaken.forced_sensitivities(),
        shaken.forced_curvature(),
        shaken.bode_bands("speed", [18.0, 19.0], ["vibration place"], checked=8),
        shaken.peaks("vibration place", "speed", 15.0, 25.0),
        shaken.peaks("vibration place", "speed", 15.0, 25.0, operating=(10.0, 16.0)),
        study.output_tolerances(),
        study.first_order(),
        study.second_order(),
        study.summary(),
        study.monte_carlo(),
        study.samples_between(0, 32),
        study.propagate([frequency]),
        study.influence([frequency]),
        study.worst_case([frequency]),
        study.chances(wanted),
        study.probability(wanted),
        study.reliability(wanted[:1]),
        study.allocate(
            wanted[:1], failure=[0.1], tolerances={"l": ("1 mm", "100 mm", (0.0, 1.0, 1.0))}
        ),
        twins.clusters(),
        twins.directional_derivatives(0, design={"a": 1.0}),
        study.sweep("speed", speeds),
        study.campbell("speed", speeds),
        study.branches("speed", 3.0, 6.0),
        study.critical("speed", 2.0, 6.0),
        study.crossings("speed", 2.0, 6.0),
        study.response("frequency 1", variables=["l"]),
        study.motion(),
        eigentol.Import(SWING, {"theta": "joint 1"}, ["a note"]),
        caught.value.mistakes[0],
    ]
    return {own.kind if isinstance(own, eigentol.Answer) else type(own).__name__: own for own in objects}
