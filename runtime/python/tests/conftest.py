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
