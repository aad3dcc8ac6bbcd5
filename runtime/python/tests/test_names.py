"""Names of instances and arrays, in settings and results."""

import pytest

import eigentol

TEXT = """
part Pendulum(length: m) {
    design mass = 2 kg +/- 1%;
    port root;
    body bar: rod(mass: mass, length: length, along: -z);
    joint hinge: revolute(y) from root to bar;
    force spring: spring(on: hinge, stiffness: 5 N*m/rad);
}
mechanism Three { gravity 9.81 m/s^2 along -z; for i in 0..3 { use a[i]: Pendulum(length: 1 m) with root: ground; } }
"""


def test_settings_name_instances_or_several_at_once():
    machine = eigentol.Mechanism.from_text(TEXT)
    study = eigentol.Study(machine, design={"a[..].mass": "3 kg", "a[1].mass": "4 kg"})
    expected = sorted((1.5 * 9.81 + 3 * 5 / mass) ** 0.5 for mass in (3.0, 4.0, 3.0))
    assert list(study.modes().frequencies) == pytest.approx(expected, rel=1e-12)
    with pytest.raises(eigentol.UnknownName, match=r"a\[7\]"):
        eigentol.Study(machine, design={"a[7].mass": "3 kg"}).modes()
