"""Forced vibration: reference values of a rotor, shapes and gaps of arrays, and the steady state by SciPy."""

import numpy as np
import pytest

import eigentol

ROTOR = """
mechanism Rotor {
    input omega: rad/s;
    design m = 12 kg;
    design k = 1.9e6 N/m +/- 5 %;
    design c = 310 N*s/m;
    design e = 0.04 mm +/- 50 %;
    body hub: massless;
    body sleeve: massless;
    body disk: cylinder(mass: m, radius: 20 cm, length: 2 cm, axis: z);
    joint x: prismatic(x) from ground to hub;
    joint y: prismatic(y) from hub to sleeve;
    joint spin: revolute(z) from sleeve to disk, driven at omega;
    force shaft1: spring(on: x, stiffness: k);
    force shaft2: spring(on: y, stiffness: k);
    force oil1: damper(on: x, damping: c);
    force oil2: damper(on: y, damping: c);
    unbalance u: on disk, eccentricity: e;
    output across = x;
    output up = y;
}
"""

# Re, Im, modulus and phase, and their first and second derivatives by one variable: z = m e W^2 / (k - m W^2 + i c W).
REFERENCE = {
    398.0: {
        "value": (-4.235387853073042e-06, -0.0006162289543775376, 0.0006162435092749451, -1.5776692936245478),
        "m": (-0.0007914366692022715, -4.047754358111762e-05, 4.5916062702665826e-05, -1.2838103216198702),
        "c": (2.732379217004318e-08, 1.987647538227426e-06, -1.987788386528705e-06, 2.217016254749289e-05),
        "omega": (-4.77035419228186e-05, -8.92689218834977e-07, 1.220530414673571e-06, -0.07739842956906322),
        "m, m": (-8.99641379231143e-05, 0.002032823455062344, -0.001016483714025653, 0.02265597767432747),
        "c, c": (-2.644071411031599e-10, -1.2821715214567801e-08, 1.2823532522578366e-08, -1.4302655030382737e-07),
    },
    200.0: {"value": (1.3495399565597027e-05, -5.892357556809969e-07, 1.3508257038229964e-05, -0.04363425826460572)},
}


@pytest.fixture(scope="module")
def spinning():
    return eigentol.Study(eigentol.Mechanism.from_text(ROTOR), inputs={"omega": 398.0})


def close(found, expected, rtol):
    np.testing.assert_allclose(found, expected, rtol=rtol)


def test_excitations_are_listed(spinning):
    mechanism = spinning.mechanism
    assert (mechanism.excitations, mechanism.harmonics) == (["u"], [["u"]])
    assert (mechanism.excitation_kinds, mechanism.excitation_orders) == (["unbalance"], ["1 spin"])
    assert "excitations: u" in repr(mechanism)


@pytest.mark.parametrize("speed", REFERENCE)
def test_a_rotor_vibrates_as_the_formula_says(spinning, speed):
    found = spinning.replace(inputs={"omega": speed}).forced_response()
    re, im, modulus, phase = REFERENCE[speed]["value"]
    across, up = found.outputs[0]
    close(found.frequencies, [speed], 1e-15)
    np.testing.assert_allclose([across, up], [re + 1j * im, -1j * (re + 1j * im)], atol=1e-11 * modulus)
    close([abs(across), np.angle(across)], [modulus, phase], 1e-10)
    close(found.amplitudes("velocity"), 1j * speed * found.outputs, 1e-14)
    np.testing.assert_array_equal(found.shares, found.outputs)


def test_derivatives_are_those_of_the_formula(spinning):
    first, second = spinning.forced_sensitivities(), spinning.forced_curvature()
    expected, names = REFERENCE[398.0], spinning.mechanism.design
    of_output, value = first.harmonics[0].outputs[0], spinning.forced_response().outputs[0, 0]
    for name in ("m", "c", "omega"):
        by = of_output.by_input[0] if name == "omega" else of_output.by_design[names.index(name)]
        re, im, modulus, phase = expected[name]
        slope = by @ [1, 1j]
        assert abs(slope - (re + 1j * im)) < 1e-9 * abs(slope)
        # dy / y = d ln |y| + i d phase.
        close((slope / value).real * abs(value), modulus, 1e-7)
        close((slope / value).imag, phase, 1e-9)
    for name in ("m", "c"):
        place = names.index(name)
        re, im, _, _ = expected[f"{name}, {name}"]
        curvature = second.harmonics[0].outputs[0].by_design[place, place] @ [1, 1j]
        assert abs(curvature - (re + 1j * im)) < 1e-8 * abs(curvature)
    close(first.harmonics[0].frequency.by_input, [1.0], 1e-14)


def test_a_bode_diagram_has_a_row_for_each_value(spinning):
    found = spinning.bode("omega", [200.0, 0.0, 398.0])
    missing = [error is not None for error in found["error"]]
    assert missing == [False, False, True, False, False]
    np.testing.assert_array_equal(np.isnan(found["amplitude"]), missing)
    vibration = found.points[2].vibration
    np.testing.assert_array_equal(vibration.response.harmonics[0].outputs @ [1, 1j], spinning.forced_response().outputs[0])
    np.testing.assert_array_equal(vibration.harmonics[0].outputs[0].by_design, spinning.forced_sensitivities().harmonics[0].outputs[0].by_design)
    assert hasattr(found.points[1].vibration, "Err")


def test_bands_are_spreads_of_amplitudes(spinning):
    wanted = ["vibration across", "vibration up under u as velocity"]
    found = spinning.replace(samples=500).bode_bands("omega", [390.0, 398.0], wanted, checked=32)
    bands = found.table("bands")
    assert (np.diff([bands[f"{percent} %"] for percent in ("2.3", "50", "97.7", "99.9")], axis=0) > 0).all()
    assert (bands["designs solved anew"] == 32).all() and len(found.banded) == 2
    alone = spinning.vibration_spread(wanted[:1])
    value = spinning.forced_response().outputs[0, 0]
    close(alone["nominal"], abs(value), 1e-12)
    response = spinning.response(wanted[0])
    close(response(response.nominal), abs(value), 1e-12)
    slopes = spinning.forced_sensitivities().harmonics[0].outputs[0].by_design @ [1, 1j]
    close(response.gradient(response.nominal), (slopes / value).real * abs(value), 1e-7)


def test_kernels_give_the_response(spinning):
    mechanism, state = spinning.mechanism, spinning.equilibrium()
    at = (state.coordinates, spinning.inputs)
    forces, frequencies, direct = mechanism.forcing(*at)
    (w,) = frequencies
    mass, damping, stiffness = mechanism.linear(*at)
    motion = np.linalg.solve(stiffness + 1j * w * damping - w**2 * mass, forces[0])
    found = spinning.forced_response()
    close(found.unknowns[0], motion, 1e-11)
    acceleration, velocity, position = mechanism.output_motion(*at)
    close((position + 1j * w * velocity - w**2 * acceleration) @ motion + direct[0], found.outputs[0], 1e-11)


def test_mistakes_are_told(spinning, study):
    with pytest.raises(eigentol.NoVibration):
        study.forced_response()
    with pytest.raises(eigentol.NoVibration):
        spinning.replace(inputs={"omega": 0.0}).forced_response()
    with pytest.raises(eigentol.UnknownName, match="did you mean `across`"):
        spinning.propagate(["vibration acros"])
    with pytest.raises(eigentol.InvalidValue, match="velocity shake"):
        spinning.response("vibration across under u as velocty")
    with pytest.raises(eigentol.InvalidValue, match="not a vibration"):
        spinning.vibration_spread(["vibration across along omega=1..2rad/s"])


FREQUENCY = 9.0


# Each machine with its excitation, and what is prescribed or exerted in the free one: a coordinate that moves, or a moment.
MACHINES = {
    "loop": (
        """
mechanism Loop {
    input size: m;
    design l = 0.4 m;
    gravity 9.81 m/s^2 along -z;
    body base: massless;
    body left: rod(mass: 1 kg, length: l, along: -z);
    body floor: rod(mass: 0.7 kg, length: 0.5 m, along: x);
    body right: rod(mass: 1.3 kg, length: 0.5 m, along: -z);
    joint shake: prismatic(x) from ground to base EXCITED;
    joint a: revolute(y) from base to left;
    joint b: revolute(y) from left to floor at [0, 0, -l];
    joint c: revolute(y) from ground to right at [0.6 m, 0, 0];
    point far: floor at [0.5 m, 0, 0];
    point foot: right at [0, 0, -0.5 m];
    constraint pin: coincident(from: far, to: foot, along: [x, z]);
    force grease: damper(on: a, damping: 0.5 N*m*s/rad);
}
""",
        "shake",
    ),
    "train": (
        """
mechanism Train {
    input size: N*m;
    design l = 0.4 m;
    gravity 9.81 m/s^2 along -z;
    body left: rod(mass: 1 kg, length: l, along: -z);
    body right: rod(mass: 2 kg, length: l, along: -z);
    joint a: revolute(y) from ground to left;
    joint b: revolute(y) from ground to right at [1 m, 0, 0];
    constraint gear: coupling(of: b, with: a, ratio: -0.5);
    force grease: damper(on: b, damping: 0.8 N*m*s/rad);
    EXCITED
}
""",
        "a",
    ),
    "arm": (
        """
mechanism Arm {
    input size: m;
    design l = 0.4 m;
    gravity 9.81 m/s^2 along -z;
    body base: massless;
    body arm: rod(mass: 1 kg, length: l, along: -z);
    joint shake: prismatic(x) from ground to base EXCITED;
    joint a: revolute(y) from base to arm;
    force elbow: spring(on: a, stiffness: 3 N*m/rad, rest: 0.5 rad);
    force grease: damper(on: a, damping: 0.3 N*m*s/rad);
}
""",
        "shake",
    ),
}


def machine(name, size):
    """The study of the excited machine, and the free one."""
    text, _ = MACHINES[name]
    excited = f", shaken(amplitude: size, frequency: {FREQUENCY} rad/s)"
    if name == "train":
        excited = f"force gust: harmonic(on: a, moment: size, frequency: {FREQUENCY} rad/s);"
    study = eigentol.Study(eigentol.Mechanism.from_text(text.replace("EXCITED", excited)), inputs={"size": size})
    return study, eigentol.Mechanism.from_text(text.replace("EXCITED", ""))


def integrated(study, free, name, size):
    """First harmonic of the steady state of the free machine with the excited coordinate moved, or its equation loaded."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is absent: no steady state is integrated")
    w, (_, excited) = FREQUENCY, MACHINES[name]
    count, place = len(free.coordinates), free.coordinates.index(excited)
    state = study.equilibrium().coordinates
    named = dict(zip(study.mechanism.coordinates, state))
    own = np.array([named.get(coordinate, 0.0) for coordinate in free.coordinates])
    moves = excited not in study.mechanism.coordinates
    found = study.forced_response().unknowns[0]
    amplitude = dict(zip(study.mechanism.coordinates, found))
    amplitude = np.array([amplitude.get(coordinate, size) for coordinate in free.coordinates])

    def padded(values):
        return np.concatenate([values, np.zeros(len(free.unknowns) - count)])

    def rates(t, y):
        q, velocity = padded(y[:count]), padded(y[count:])
        acceleration = free.accelerations(velocity, q)
        # What a force on the coordinate adds, with the reactions of constraints.
        matrix, stiffness = free.mass_and_forces(velocity, q)[0], free.linear(q)[2]
        matrix[count:, :count], matrix[:count, count:] = stiffness[count:, :count], stiffness[:count, count:]
        pushed = np.linalg.solve(matrix, np.eye(len(q))[place])
        force = size * np.cos(w * t)
        if moves:
            force = (-(w**2) * force - acceleration[place]) / pushed[place]
        return np.concatenate([y[count:], (acceleration + force * pushed)[:count]])

    # Near the steady state, with the constraints met: what is left of the transient dies away.
    q, velocity = own + amplitude.real, (1j * w * amplitude).real
    others = [k for k in range(count) if k != place or not moves]
    for _ in range(4):
        slopes = free.linear(padded(q))[2][count:, :count]
        q[others] -= np.linalg.pinv(slopes[:, others]) @ free.residual(padded(q))[count:]
        velocity[others] -= np.linalg.pinv(slopes[:, others]) @ slopes @ velocity
    start = np.concatenate([q, velocity])
    period = 2 * np.pi / w
    times = 30 * period + period * np.arange(32) / 32
    run = integrate.solve_ivp(rates, (0, times[-1]), start, t_eval=times, rtol=1e-9, atol=1e-9 * size, method="DOP853")
    assert run.success
    first = 2 * np.mean(run.y[:count] * np.exp(-1j * w * times), axis=1)
    return first, amplitude


@pytest.mark.parametrize("name", MACHINES)
def test_the_steady_state_by_scipy(name):
    errors = []
    for size in (1e-2, 1e-3):
        study, free = machine(name, size)
        found, expected = integrated(study, free, name, size)
        errors.append(np.abs(found - expected).max() / np.abs(expected).max())
    # The error falls with the square of the amplitude, down to that of the integrator.
    assert errors[1] < 1e-3 and errors[1] < max(0.03 * errors[0], 1e-6), errors


def test_the_peak_of_a_rotor_is_that_of_the_formula(spinning):
    found = spinning.peaks("vibration across", "omega", 100.0, 900.0)
    (peak,) = found.peaks
    close(peak.place.value, 398.3311669843997, 1e-9)
    close(peak.height.value, 0.000616445456224498, 1e-9)
    half_power = [found["half power before"][0], found["half power after"][0]]
    close(half_power, [385.9795992849649, 411.94983284900997], 1e-9)
    close(found["amplification"], [15.337989394745996], 1e-9)
    k = spinning.mechanism.design.index("k")
    close(peak.place.by_design[k], 0.00010460261280203874, 1e-7)
    close(peak.height.by_design[k], 1.6205136977782588e-10, 1e-7)
    close(peak.amplification.by_design[k], 4.070591191155354e-06, 1e-7)
    assert found["sigma of place"][0] > 0
    assert "peaks of the vibration" in str(found)


def test_a_peak_keeps_away_from_operation(spinning):
    wanted = ("vibration across", "omega", 100.0, 900.0)
    found, (peak,) = spinning.peaks(*wanted, operating=(450.0, "600 rad/s")), spinning.peaks(*wanted).peaks
    place, factor = peak.place.value, peak.amplification.value
    close(found["separation margin"], [1.0 - place / 450.0], 1e-12)
    close(found["required margin"], [0.17 * (1.0 - 1.0 / (factor - 1.5))], 1e-12)
    close(found.margins[0].actual.by_design, -peak.place.by_design / 450.0, 1e-12)
    close(found["sigma of margin"], peak.place.spread.sigma / 450.0, 1e-12)
    assert found.operating.tolist() == [450.0, 600.0] and found["sufficient"] == [False]
    assert spinning.peaks(*wanted, operating=(600.0, 700.0))["sufficient"] == [True]
    with pytest.raises(eigentol.InvalidValue, match="starts above"):
        spinning.peaks(*wanted, operating=(600.0, 450.0))


def test_an_orbit_of_an_isotropic_rotor_is_a_circle(spinning):
    found = spinning.forced_response()
    forward, backward = found.orbit_parts("across", "up")
    close(forward, found.outputs[:, 0], 1e-12)
    assert abs(backward[0]) < 1e-12 * abs(forward[0])
    close(found.orbit_semi_axes("across", "up"), np.abs([forward, forward]), 1e-11)
    assert np.isnan(found.orbit_directions("across", "up")).all()
    assert found.orbit_turnings("across", "up") == ["forward"]
    assert found.orbit_turnings("up", "across") == ["backward"]
    with pytest.raises(eigentol.UnknownName, match="did you mean `across`"):
        found.orbit_turnings("acros", "up")


def test_an_orbit_across_unequal_springs_is_an_ellipse():
    text = ROTOR.replace("shaft2: spring(on: y, stiffness: k)", "shaft2: spring(on: y, stiffness: 2.2e6 N/m)")
    found = eigentol.Study(eigentol.Mechanism.from_text(text), inputs={"omega": 410.0}).forced_response()
    (x, y), (forward, backward) = found.outputs[0], found.orbit_parts("across", "up")
    close([forward[0], backward[0]], [(x + 1j * y) / 2, (x - 1j * y) / 2], 1e-12)
    time = np.linspace(0.0, 2.0 * np.pi, 20001)
    path = (x * np.exp(1j * time)).real + 1j * (y * np.exp(1j * time)).real
    longest, shortest = found.orbit_semi_axes("across", "up")
    close([longest[0], shortest[0]], [abs(path).max(), abs(path).min()], 1e-6)
    direction = np.exp(1j * found.orbit_directions("across", "up")[0])
    assert abs((path[abs(path).argmax()] / direction).imag) < 1e-3 * longest[0]
    area = (path.conj()[:-1] * path[1:]).imag.sum()
    assert found.orbit_turnings("across", "up") == ["forward" if area > 0 else "backward"]


def test_unknown_phases_are_those_of_random_ones():
    text = ROTOR.replace("output across", "force gust: harmonic(on: x, force: 300 N, frequency: omega);\n    output across")
    study = eigentol.Study(eigentol.Mechanism.from_text(text), inputs={"omega": 380.0})
    found = study.forced_response()
    a, b = abs(found.shares[:, 0])
    close(found.unknown_phases_quantile(1.0)[0, 0], a + b, 1e-12)
    close(found.unknown_phases_quantile(0.0)[0, 0], abs(a - b), 1e-9)
    close(found.unknown_phases_root_mean_square()[0, 0], np.hypot(a, b), 1e-12)
    close(found.unknown_phases_quantile(0.5)[0, 0], np.hypot(a, b), 1e-9)
    close(found.unknown_phases_quantile(0.5, "velocity")[0, 0], 380.0 * np.hypot(a, b), 1e-9)
    close(found.unknown_phases_probability("across", np.hypot(a, b)), [0.5], 1e-9)
    close(found.unknown_phases_probability("across", f"{1e3 * np.hypot(a, b)} mm"), [0.5], 1e-9)
    with pytest.raises(eigentol.InvalidValue, match="probability"):
        found.unknown_phases_quantile(1.5)


def test_shares_and_orbits_have_derivatives():
    gust = "force gust: harmonic(on: x, force: 300 N, frequency: omega);\n    output across"
    text = ROTOR.replace("output across", gust)
    study = eigentol.Study(eigentol.Mechanism.from_text(text), inputs={"omega": 380.0})
    alone, together = study.share_sensitivities(), study.forced_sensitivities()
    shares = [own.outputs @ [1, 1j] for own in alone.response.harmonics]
    np.testing.assert_array_equal(shares, study.forced_response().shares)

    def slopes(harmonic):
        return np.array([output.by_design @ [1, 1j] for output in harmonic.outputs])

    parts, whole = np.array([slopes(own) for own in alone.harmonics]), slopes(together.harmonics[0])
    assert (abs(parts.sum(axis=0) - whole) <= 1e-12 * np.abs(parts).sum(axis=0)).all()
    # x + i y = f e^{i w t} + conj(b) e^{-i w t}.
    of = study.forced_response().outputs[0]
    sides = [
        study.replace(design={"k": 1.9e6 + side}).forced_response().orbit_parts("across", "up") for side in (10.0, -10.0)
    ]
    k = study.mechanism.design.index("k")
    for turn, (above, below) in zip((1j, -1j), zip(*sides, strict=True), strict=True):
        part, slope = (of[0] + turn * of[1]) / 2, (whole[0] + turn * whole[1]) / 2
        expected = (abs(above[0]) ** 2 - abs(below[0]) ** 2) / 20.0
        close(2 * (part.conj() * slope).real[k], expected, 1e-6)
