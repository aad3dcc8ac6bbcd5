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


ROTOR = """
part Blade() {
    design k = 250 N*m/rad +/- 3%;
    port root;
    body arm: rigid(mass: 1 kg, inertia: [0.002, 0.002, 0.004] kg*m^2);
    joint flap: revolute(z) from root to arm;
    force hinge: spring(on: flap, stiffness: k);
    force damp: damper(on: flap, damping: 0.002 N*m*s/rad);
}
mechanism Disc {
    body disk: massless;
    joint seat: fixed from ground to disk;
    cyclic blade[0..4] about z { use blade: Blade() with root: disk; }
    for i in 0..4 {
        force tie[i]: potential(energy: 2 N*m * (blade[i].flap - blade[(i + 1) % 4].flap)^2 / 2);
    }
}
"""


def test_blades_have_patterns_and_a_worst_one():
    study = eigentol.Study(eigentol.Mechanism.from_text(ROTOR))
    assert sorted(study.patterns()) == ["1 diameter", "1 diameter", "collective", "differential"]
    assert set(study.kinds()) == {"blades"}
    found = study.mistuning(1, coordinate="flap", samples=200)
    factors = found.table("samples")["amplification factor"]
    assert len(factors) == 200 and min(factors) > 0.8 and 1.05 < max(factors) < 1.6
    with pytest.raises(eigentol.Error, match="no coordinate `lag`"):
        study.mistuning(1, coordinate="lag")
