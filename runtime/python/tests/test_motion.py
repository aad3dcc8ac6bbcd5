"""The motion, integrated by SciPy, against conserved and balanced energy."""

import numpy as np
import pytest

import eigentol

integrate = pytest.importorskip("scipy.integrate", reason="SciPy is absent: the motion is not integrated")

G = 9.81
TIGHT = {"rtol": 1e-11, "atol": 1e-12, "method": "DOP853"}


def test_the_turning_bar_keeps_its_jacobi_integral(study):
    motion = study.motion()
    assert motion.names == ["theta", "theta'"]
    y0 = motion.state({"theta": "10 deg"}, {"theta": 1.5})
    found = integrate.solve_ivp(motion, (0, 20), y0, **TIGHT)
    assert found.success
    theta, rate = found.y
    # With m = 3, l = 1: kinetic energy relative to the shaft, centrifugal potential, weight.
    energy = 0.5 * rate**2 - 0.5 * 25 * np.sin(theta) ** 2 - 1.5 * G * np.cos(theta)
    assert np.ptp(theta) > 1.0
    assert np.ptp(energy) < 1e-8 * np.ptp(0.5 * rate**2)


def test_small_swings_have_the_frequency_of_the_mode(study):
    motion, state = study.motion(), study.equilibrium()
    frequency = study.modes().frequencies[0]
    y0 = motion.state(state.coordinates + 1e-5)
    period = 2 * np.pi / frequency
    found = integrate.solve_ivp(motion, (0, 10 * period), y0, **TIGHT)
    np.testing.assert_allclose(found.y[0, -1] - state.coordinates[0], 1e-5, rtol=1e-4)


def test_a_damper_takes_what_the_energy_loses():
    mechanism = eigentol.Mechanism.from_text(
        """mechanism Damped {
            design c = 0.4 N*m*s/rad;
            gravity 9.81 m/s^2 along -z;
            body upper: rod(mass: 1 kg, length: 1 m, along: -z);
            body lower: rod(mass: 2 kg, length: 0.5 m, along: -z);
            joint a: revolute(y) from ground to upper;
            joint b: revolute(y) from upper to lower at [0, 0, -1 m];
            force friction: damper(on: a, damping: c);
        }"""
    )
    motion = mechanism.motion()

    def power(t, y):
        return np.append(motion(t, y[:-1]), 0.4 * y[2] ** 2)

    y0 = np.append(motion.state({"a": 1.0, "b": -0.5}), 0.0)
    found = integrate.solve_ivp(power, (0, 5), y0, **TIGHT)
    a, b, va, vb, lost = found.y

    def kinetic(k):
        mass, _ = mechanism.mass_and_forces([va[k], vb[k]], [a[k], b[k]])
        v = np.array([va[k], vb[k]])
        return v @ mass @ v / 2

    potential = -1 * G * 0.5 * np.cos(a) - 2 * G * (np.cos(a) + 0.25 * np.cos(a + b))
    energy = np.array([kinetic(k) for k in range(len(a))]) + potential
    assert lost[-1] > 1.0
    np.testing.assert_allclose(energy + lost, energy[0], atol=1e-8)


def test_a_speed_has_no_rate():
    mechanism = eigentol.Mechanism.from_text(
        """mechanism Coasting {
            body r: rigid(mass: 1 kg, inertia: [0.01, 0.01, 0.01] kg*m^2);
            joint s: revolute(z) from ground to r, coasting;
            force drive: generalized(on: s, value: 1 N*m - 0.1 N*m*s/rad * rate(s));
        }"""
    )
    motion = mechanism.motion()
    assert motion.state({"s": 20.0}) == [20.0]
    with pytest.raises(eigentol.InvalidValue, match="`s` has no rate"):
        motion.state({}, {"s": 20.0})
