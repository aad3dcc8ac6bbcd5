"""Robots of other people's making against numbers of Pinocchio, from declarations and from URDF files."""

import json
import sysconfig
from pathlib import Path

import numpy as np
import pytest

import eigentol

TRUTH = Path(__file__).resolve().parents[3] / "tests" / "truth" / "robots"
PACKAGE = Path(sysconfig.get_paths()["purelib"], "cmeel.prefix/share/example-robot-data/robots")
# The largest takes long to derive without optimisation.
NAMES = ["Kinova", "Panda", "Solo12Free", "TalosArm", "Ur5", "Xarm7"]


def agree(ours, theirs):
    theirs = np.array(theirs)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())


def compare(mechanism, truth, order):
    """Numbers of all states; `order` are the places of their coordinates among ours."""
    for state in truth["states"]:
        at = {}
        for name in ["q", "v", "a", "w"]:
            at[name] = np.empty(len(order))
            at[name][order] = state[name]
        agree(mechanism.residual(at["q"])[order], state["tau_rest"])
        mass, forces = mechanism.mass_and_forces(at["v"], at["q"])
        agree((mass @ at["w"])[order], state["mass_w"])
        agree((mass @ at["a"] - forces)[order], state["tau"])
        _, _, stiffness = mechanism.linear(at["q"])
        agree((stiffness @ at["w"])[order], state["rest_dq_w"])
        # Their torque is what our accelerations would need.
        free = mechanism.accelerations(at["v"], at["q"])
        agree((mass @ (at["a"] - free))[order], state["tau"])


@pytest.mark.parametrize("name", NAMES)
def test_declared_robots(name):
    truth = json.loads((TRUTH / f"{name}.json").read_text())
    mechanism = eigentol.Mechanism.from_file(TRUTH / f"{name}.mech")
    compare(mechanism, truth, [mechanism.coordinates.index(own) for own in truth["coordinates"]])


@pytest.mark.parametrize("name", NAMES)
def test_robots_of_urdf_files(name):
    if not PACKAGE.is_dir():
        pytest.skip("the package example-robot-data is absent: no URDF file is read")
    truth = json.loads((TRUTH / f"{name}.json").read_text())
    base = "floating" if truth["base"] == "free" else "fixed"
    found = eigentol.import_urdf(PACKAGE / truth["source"], base=base, file_damping=False)
    mechanism = found.mechanism()
    if len(mechanism.coordinates) != len(truth["coordinates"]):
        # The numbers are for fingers that move by themselves; the file says that one mimics the other.
        assert any("mimic" in note for note in found.notes) or "coupling" in found.declaration
        return
    if base == "floating":
        # Names of the base are ours; both list it first, displacements before turns.
        order = list(range(len(truth["coordinates"])))
    else:
        original = [found.names.get(own, own) for own in mechanism.coordinates]
        order = [original.index(own) for own in truth["coordinates"]]
    compare(mechanism, truth, order)


def test_mistakes_of_a_urdf_file_have_places(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text('<robot name="r">\n  <link name="a"/>\n  <joint name="j" type="revolut"/>\n</robot>\n')
    with pytest.raises(eigentol.DeclarationError) as caught:
        eigentol.Mechanism.from_urdf(path)
    assert any(mistake.line == 3 for mistake in caught.value.mistakes)
    assert str(path) in str(caught.value)
    with pytest.raises(FileNotFoundError):
        eigentol.import_urdf(tmp_path / "nowhere.urdf")
    with pytest.raises(TypeError, match="did you mean `base`"):
        eigentol.import_urdf(path, bass="fixed")
    with pytest.raises(eigentol.InvalidValue, match="floating"):
        eigentol.import_urdf(path, base="flying")
    with pytest.raises(eigentol.InvalidValue, match="finite"):
        eigentol.import_urdf(path, stiffness=float("nan"))
