"""Robots of other people's making against numbers of Pinocchio, from declarations and from URDF files."""

import json
import sysconfig
from pathlib import Path

import numpy as np
import pytest

import eigentol

TRUTH = Path(__file__).resolve().parents[3] / "tests" / "truth" / "robots"
PACKAGE = Path(sysconfig.get_paths()["purelib"], "cmeel.prefix/share/example-robot-data/robots")
NAMES = sorted(path.stem for path in TRUTH.glob("*.json"))


def without_suffix(name):
    """Theirs has `LF_HAA_joint` where the file has a joint `LF_HAA` beside a link of that name."""
    return name.removesuffix("_joint")


def agree(ours, theirs):
    theirs = np.array(theirs)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())


def compare(mechanism, truth, order):
    """Numbers of all states; `order` says where their coordinates are among ours.

    Where fingers mimic each other ours has reactions too: they are zero here, and theirs has none.
    """
    n, own = len(mechanism.unknowns), order
    for state in truth["states"]:
        at = {name: np.zeros(n) for name in "qvaw"}
        for name, values in at.items():
            values[own] = state[name]
        agree(mechanism.residual(at["q"])[own], state["tau_rest"])
        mass, forces = mechanism.mass_and_forces(at["v"], at["q"])
        agree((mass @ at["w"])[own], state["mass_w"])
        agree((mass @ at["a"] - forces)[own], state["tau"])
        _, _, stiffness = mechanism.linear(at["q"])
        agree((stiffness @ at["w"])[own], state["rest_dq_w"])
        if n == len(truth["coordinates"]):
            # Their torque is what takes our accelerations to theirs.
            free = mechanism.accelerations(at["v"], at["q"])
            agree((mass @ (at["a"] - free))[own], state["tau"])


@pytest.mark.parametrize("name", NAMES)
def test_declared_robots(name):
    truth = json.loads((TRUTH / f"{name}.json").read_text())
    mechanism = eigentol.Mechanism.from_file(TRUTH / f"{name}.mech")
    assert mechanism.coordinates[: len(truth["coordinates"])] == truth["coordinates"]
    compare(mechanism, truth, list(range(len(truth["coordinates"]))))


@pytest.mark.parametrize("name", NAMES)
def test_robots_of_urdf_files(name):
    if not PACKAGE.is_dir():
        pytest.skip("the package example-robot-data is absent: no URDF file is read")
    truth = json.loads((TRUTH / f"{name}.json").read_text())
    path = PACKAGE / truth["source"]
    base = "floating" if truth["base"] == "free" else "fixed"
    options = {"base": base, "file_damping": False}
    try:
        found = eigentol.import_urdf(path, **options)
    except eigentol.DeclarationError as error:
        assert all("is that of no body" in mistake.message for mistake in error.mistakes)
        assert any(kind == "inertia" for kind, _ in truth["changed"])
        found = eigentol.import_urdf(path, **options, nearest_inertias=True)
    mechanism = found.mechanism()
    if base == "floating":
        # Names of the base differ; both list it first, displacements before turns.
        order = list(range(len(truth["coordinates"])))
    else:
        original = [found.names.get(own, own) for own in mechanism.coordinates]
        order = [original.index(own if own in original else without_suffix(own)) for own in truth["coordinates"]]
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
