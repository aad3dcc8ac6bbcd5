"""The bar on a turning shaft against its closed form.

With the angle theta of the bar (length l, mass m, hinged at its end) about the horizontal y axis of a shaft that turns at omega,
cos theta* = 3 g / (2 l omega^2), and the natural frequency is omega sin theta*.
"""

import math
import os
import signal
import threading

import numpy as np
import pytest

import eigentol

G, LENGTH, MASS, SPEED = 9.81, 1.0, 3.0, 5.0
COSINE = 3 * G / (2 * LENGTH * SPEED**2)


def frequency(length, speed=SPEED):
    return np.sqrt(speed**2 - (3 * G / (2 * length * speed)) ** 2)


def slope(length, speed=SPEED):
    a = 3 * G / (2 * speed)
    return a**2 / length**3 / frequency(length, speed)


def test_equilibrium_and_matrices(study):
    state = study.equilibrium()
    inertia = MASS * LENGTH**2 / 3
    assert state.names == ["theta"]
    assert state.stable and state.stability == "stable"
    np.testing.assert_allclose(state.coordinates, [np.arccos(COSINE)], rtol=1e-12)
    np.testing.assert_allclose(state.mass, [[inertia]], rtol=1e-12)
    np.testing.assert_allclose(state.damping, [[0.0]], atol=1e-12)
    np.testing.assert_allclose(state.stiffness, [[inertia * frequency(LENGTH) ** 2]], rtol=1e-12)


def test_modes(study):
    modes = study.modes()
    np.testing.assert_allclose(modes.frequencies, [frequency(LENGTH)], rtol=1e-12)
    np.testing.assert_allclose(modes.eigenvalues, [1j * frequency(LENGTH)], rtol=1e-12)
    assert modes.eigenvalues.dtype == np.complex128
    assert modes.shapes.shape == (1, 1) and modes.family == "undamped" and len(modes) == 1
    mass = study.equilibrium().mass
    np.testing.assert_allclose(modes.shapes.conj() @ mass @ modes.shapes.T, [[1.0]], rtol=1e-12)


def test_first_derivatives(study):
    by_input, by_design = study.sensitivities().of("frequency")
    a = 3 * G / (2 * LENGTH)
    by_speed = (SPEED + a**2 / SPEED**3) / frequency(LENGTH)
    np.testing.assert_allclose(by_input, [[by_speed]], rtol=1e-12)
    np.testing.assert_allclose(by_design, [[0.0, slope(LENGTH)]], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(study.sensitivities().by_design.imag, by_design, atol=1e-12)


def test_hessian(study):
    a, omega = 3 * G / (2 * SPEED), frequency(LENGTH)
    curvature = -3 * a**2 / LENGTH**4 / omega - slope(LENGTH) ** 2 / omega
    found = study.mode_curvature(0)
    table = found.table()
    hessian = dict(zip(zip(table["by"], table["and by"]), table["Im s [1/s per units]"]))
    np.testing.assert_allclose([hessian["m", "l"], hessian["l", "l"]], [0.0, curvature], rtol=1e-10, atol=1e-10)
    # lambda = omega^2.
    expected = 2 * (slope(LENGTH) ** 2 + omega * curvature)
    of_lambda = getattr(found, "lambda").by_design
    np.testing.assert_allclose(of_lambda, [[0.0, 0.0], [0.0, expected]], rtol=1e-10, atol=1e-9)


def test_hessians_of_numbers(study):
    ratio = COSINE / math.sqrt(1 - COSINE**2)
    angle = study.output_curvature("angle")
    assert angle.value == pytest.approx(math.acos(COSINE)) and angle.asymmetry < 1e-12
    np.testing.assert_allclose(angle.first.by_design, [0.0, ratio / LENGTH], rtol=1e-12, atol=1e-12)
    expected = -ratio * (2 + ratio**2) / LENGTH**2
    np.testing.assert_allclose(angle.second.by_design, [[0.0, 0.0], [0.0, expected]], rtol=1e-10, atol=1e-10)
    critical = study.critical_curvature("omega", 0.5, 8.0)
    speed = math.sqrt(1.5 * G / LENGTH)
    expected = 0.75 * speed / LENGTH**2
    assert critical.value == pytest.approx(speed)
    np.testing.assert_allclose(critical.second, [[0.0, 0.0], [0.0, expected]], rtol=1e-9, atol=1e-9)
    with pytest.raises(eigentol.UnknownName):
        study.output_curvature("angel")


def test_first_order_spread(study):
    found = study.first_order()
    sigma = slope(LENGTH) * 0.03 * LENGTH / 3
    np.testing.assert_allclose(found["sigma of frequency"], [sigma], rtol=1e-12)
    np.testing.assert_allclose(found["band of frequency"], [3 * sigma], rtol=1e-12)
    shares = [found[f"variance share of {name}"][0] for name in ("m", "l")]
    np.testing.assert_allclose(shares, [0.0, 1.0], atol=1e-12)
    assert found["doubts"] == [None]
    half = study.replace(tolerances={"l": "15 mm"}).first_order()["sigma of frequency"]
    np.testing.assert_allclose(half, [sigma / 2], rtol=1e-12)
    listed = study.replace(tolerances={"l": "one of [0.97, 1.03] m"}).first_order()["sigma of frequency"]
    np.testing.assert_allclose(listed, [3 * sigma], rtol=1e-12)


def test_an_input_with_a_tolerance_is_a_variable(study):
    found = study.replace(tolerances={"omega": 0.1}).first_order()
    by_speed = study.sensitivities().of("frequency")[0][0, 0]
    own = np.hypot(slope(LENGTH) * 0.01, by_speed * 0.1 / 3)
    np.testing.assert_allclose(found["sigma of frequency"], [own], rtol=1e-12)
    assert len(found.modes[0].__dict__["lambda"].by_design) == 3


def test_units_and_numbers_agree(pendulum):
    rpm = 5 * 60 / (2 * np.pi)
    a = eigentol.Study(pendulum, inputs={"omega": f"{rpm!r} rpm"}, start={"theta": "57 deg"})
    assert abs(a.inputs[0] - 5.0) < 1e-14
    b = a.replace(design={"l": "1500 mm"})
    np.testing.assert_allclose(b.modes().frequencies, [frequency(1.5)], rtol=1e-12)
    np.testing.assert_allclose(a.modes().frequencies, [frequency(1.0)], rtol=1e-12)


def test_samples_are_arrays(study):
    found = study.replace(samples=400, keep_samples=True, seed=3).monte_carlo()
    assert (found.seed, found.stream) == (3, 0)
    assert found.designs.shape == (400, 2) and found.frequencies.shape == (400, 1)
    np.testing.assert_allclose(found.frequencies[:, 0], frequency(found.designs[:, 1]), rtol=1e-9)
    np.testing.assert_allclose(found.eigenvalues.imag, found.frequencies, rtol=1e-9)
    np.testing.assert_allclose(found.sigma(), found.frequencies.std(axis=0, ddof=1), rtol=1e-9)
    assert found.counts["Stable"] == 400 and found.outcomes == ["Stable"] * 400


def test_sweep_and_critical_speed(study):
    speeds = np.array([2.0, 4.0, 6.0])
    sweep = study.sweep("omega", speeds)
    at_rest = np.sqrt(3 * G / 2 - 2.0**2)
    expected = [at_rest, frequency(1.0, 4.0), frequency(1.0, 6.0)]
    np.testing.assert_allclose(sweep.frequencies[:, 0], expected, rtol=1e-9)
    assert sweep.failures == [None] * 3 and len(sweep) == 3
    critical = np.sqrt(3 * G / 2)
    np.testing.assert_allclose(sweep.critical, [critical], rtol=1e-9)
    event = study.critical("omega", 1.0, "10 rad/s")
    assert abs(event.value - critical) < 1e-9
    np.testing.assert_allclose(event.spread.by_design, [0.0, -critical / 2], rtol=1e-6, atol=1e-9)
    in_rpm = study.sweep("omega", [30, 40], unit="rpm")
    np.testing.assert_allclose(in_rpm.values, np.array([30, 40]) * 2 * np.pi / 60)
    as_texts = study.sweep("omega", ["30 rpm", "40 rpm"])
    np.testing.assert_array_equal(as_texts.values, in_rpm.values)


def test_campbell(study):
    found = study.campbell("omega", [5.0, 6.0], orders=[0.9])
    np.testing.assert_allclose(found["frequency"], frequency(1.0, np.array([5.0, 6.0])))
    sigmas = slope(1.0, np.array([5.0, 6.0])) * 0.01
    np.testing.assert_allclose(found["sigma of frequency"], sigmas, rtol=1e-9)
    # omega sin theta* = 0.9 omega where (3 g / (2 l omega^2))^2 = 0.19.
    (crossing,) = found.crossings
    assert abs(crossing.value - np.sqrt(3 * G / 2 / np.sqrt(0.19))) < 1e-8


def test_event_map(study):
    found = study.event_map("omega", 1.0, "8 rad/s", "l", [0.5, "100 cm"], orders=[])
    assert [over for over, events in found.points] == [0.5, 1.0]
    # The bar swings outwards where omega^2 = 3 g / (2 l).
    for (over, _), value in zip(found.points, found["omega"]):
        np.testing.assert_allclose(value, np.sqrt(1.5 * G / over), rtol=1e-7)
    with pytest.raises(eigentol.UnknownName, match="that is an input"):
        study.event_map("omega", 1.0, 8.0, "omega", [0.5])


def test_branches(study):
    found = study.branches("omega", 1.0, 8.0)
    special = [special.value for branch in found.branches for special in branch.special]
    assert special and np.allclose(special, np.sqrt(3 * G / 2), rtol=1e-9)
    upper = found.branches[0]
    assert len(upper.points) == (found["branch"] == 1).sum()
    assert upper.points[0].equilibrium.coordinates[0] == pytest.approx(found["theta"][0])


def test_response_is_a_function_of_arrays(study):
    response = study.response("frequency 1", variables=["l"])
    lengths = np.array([[0.9], [1.0], [1.2]])
    np.testing.assert_allclose(response(lengths), frequency(lengths[:, 0]), rtol=1e-12)
    np.testing.assert_allclose(response.gradient(lengths), slope(lengths), rtol=1e-10)
    assert isinstance(response([1.0]), float) and response.names == ["l"]
    # Shorter than 3 g / (2 omega^2) the bar hangs, and longer ones swing out; no length is negative.
    assert np.isnan(response([[-1.0], [np.nan]])).all()
    angle = study.response("angle")
    np.testing.assert_allclose(angle(angle.nominal), np.arccos(COSINE), rtol=1e-12)
    critical = study.response("critical omega=1..10rad/s")
    np.testing.assert_allclose(critical([3.0, 2.0]), np.sqrt(3 * G / 4), rtol=1e-9)
    # frequency = 0.8 omega where omega^2 = 3 g / (1.2 l).
    resonance = study.response("resonance 1 omega=4..8rad/s order 0.8")
    np.testing.assert_allclose(resonance([3.0, 1.1]), np.sqrt(3 * G / 1.2 / 1.1), rtol=1e-9)
    assert np.isnan(study.response("flutter 1 omega=4..8rad/s")([3.0, 1.1]))
    with pytest.raises(eigentol.InvalidValue, match="not a response"):
        study.response("flutter 1 omega=4..8rad/s order 0.8")


def test_spreads_of_responses(study):
    found = study.propagate(["frequency 1", "output angle"])
    rule = np.polynomial.hermite_e.hermegauss(40)
    weights = rule[1] / rule[1].sum()
    values = frequency(1 + 0.01 * rule[0])
    mean = weights @ values
    sigma = np.sqrt(weights @ (values - mean) ** 2)
    assert found.covariance.shape == (2, 2) and len(found.table("quantiles")["value"]) == 14
    assert abs(found["sigma"][0] - sigma) < 5 * found["error of sigma"][0]
    assert abs(found["mean"][0] - mean) < 1e-3 * sigma
    worst = study.worst_case(["frequency 1"])
    np.testing.assert_allclose(worst["least"], [frequency(0.97)], rtol=1e-9)
    np.testing.assert_allclose(worst["greatest"], [frequency(1.03)], rtol=1e-9)
    influence = study.influence(["frequency 1"])
    assert influence["of"] == ["l"]
    np.testing.assert_allclose(influence["at high"], [frequency(1.03)], rtol=1e-9)


def test_probability_of_a_band(study):
    # The frequency grows with the length, so that the band is one of lengths: exact by the normal distribution of l.
    low = frequency(1.0) - 1.0
    found = study.probability([f"frequency 1 outside {low}..{frequency(1.01)} rad/s"])
    assert found.each[0].value == pytest.approx(0.8413447, abs=2e-3)


def test_requirements(study):
    # The frequency grows with the length: at least that of 0.99 m is at least one standard deviation below.
    wanted = [f"frequency 1 >= {frequency(0.99)} rad/s", "stable"]
    expected = 0.5 * math.erfc(1 / math.sqrt(2))
    found = study.reliability(wanted)
    np.testing.assert_allclose(found["probability of failure, first order"], [expected], rtol=1e-6)
    np.testing.assert_allclose(found["beta"], [1.0], rtol=1e-6)
    chances = study.replace(samples=20_000).chances(wanted)
    error = math.sqrt(expected * (1 - expected) / 20_000)
    failure = chances["probability of failure"]
    assert abs(failure[0] - expected) < 4 * error
    assert failure[1] == 0.0 and chances.all.met == chances.each[0].met


def test_probability_of_failure(study):
    expected = [0.5 * math.erfc(4 / math.sqrt(2)), 0.5 * math.erfc(1 / math.sqrt(2))]
    wanted = [f"frequency 1 >= {frequency(0.96)} rad/s", f"frequency 1 <= {frequency(1.01)} rad/s"]
    found = study.probability(wanted)
    failure = found["probability of failure"]
    np.testing.assert_allclose(failure[:2], expected, rtol=1e-6)
    assert (found["95 % from"] <= failure).all() and (failure <= found["95 % to"]).all()
    assert [own.by for own in found.each] == ["DesignPoint", "DesignPoint"]
    assert found.any.value == pytest.approx(sum(expected), rel=1e-6)
    low, high = found.any.interval.lower, found.any.interval.upper
    assert low <= sum(expected) * (1 + 1e-6) and sum(expected) <= high * (1 + 1e-6)
    points = found.table("design points")
    assert points["verified"] == [True, True] and max(own.untold for own in found.each) == 0
    np.testing.assert_allclose(points["probability, solved anew"], expected, rtol=1e-6)


def test_a_layer_beside_the_critical_length_is_no_half_space(study):
    # Longer bars than the critical one stand out to the side, shorter ones hang down: slow only within a layer.
    speed, sigma = 1.03 * math.sqrt(1.5 * G), 0.2 / 3
    near = study.replace(
        inputs={"omega": speed}, start={"theta": 0.4}, tolerances={"l": 0.2}
    )
    wanted = ["frequency 1 >= 0.1 rad/s"]

    def until(length):
        return 0.5 * math.erfc(-(length - 1) / sigma / math.sqrt(2))

    # Hanging: 1.5 g / l - speed^2 = 0.01; standing out: speed^2 - (1.5 g / l / speed)^2 = 0.01.
    shortest = 1.5 * G / (speed**2 + 0.01)
    longest = 1.5 * G / speed / math.sqrt(speed**2 - 0.01)
    expected = until(longest) - until(shortest)
    reliability = near.reliability(wanted)
    assert reliability["verified"] == [False]
    assert reliability["probability of failure, first order"][0] > 10 * expected
    np.testing.assert_allclose(reliability["probability, solved anew"], [expected], rtol=1e-6)
    found = near.probability(wanted)
    assert found.each[0].by == "Lines"
    np.testing.assert_allclose(found.each[0].value, expected, rtol=1e-6)
    doubts = near.first_order()["doubts"]
    assert len(doubts) == 1 and "critical" in doubts[0]


def test_standard_errors_are_those_of_what_they_name(study):
    found = study.replace(samples=4000, seed=3).monte_carlo()
    n = 4000
    np.testing.assert_allclose(found.standard_error(), found.sigma() / math.sqrt(n), rtol=1e-3)
    # Nearly normal: sigma / sqrt(2 n).
    np.testing.assert_allclose(found.sigma_error(), found.sigma() / math.sqrt(2 * n), rtol=0.1)
    assert found.on_another_branch == 0


def test_a_forbidden_band_is_the_rest_of_a_wanted_one(study):
    low, high = frequency(0.99), frequency(1.01)
    study = study.replace(samples=20_000)
    inside = study.chances([f"frequency 1 within {low}..{high} rad/s"])
    outside = study.chances([f"frequency 1 outside {low}..{high} rad/s"])
    inside, outside = inside["probability of failure"][0], outside["probability of failure"][0]
    assert 0 < inside < 1 and inside + outside == pytest.approx(1, abs=1e-12)


def test_cheapest_tolerance(study):
    # One in a thousand falls below the frequency of 0.99 m, so that 1 cm is 3.0902 standard deviations; three make a half-width.
    wanted = [f"frequency 1 >= {frequency(0.99)} rad/s"]
    found = study.replace(samples=20_000).allocate(
        wanted, failure=[1e-3], tolerances={"l": ("1 mm", "10 cm", (1.0, 0.5, 2.0))}
    )
    expected = 3 * 0.01 / 3.090232306167813
    np.testing.assert_allclose(found.half_widths[study.mechanism.design.index("l")], expected, rtol=1e-6)
    assert found.cost == pytest.approx(1 + 0.5 / expected**2, rel=1e-6)
    assert found.refuted == [] and found.table("requirements")["probability of failure, sampled"][0] < 3e-3
    with pytest.raises(eigentol.UnknownName, match="did you mean"):
        study.allocate(wanted, failure=[1e-3], tolerances={"ll": (1e-3, 1e-1, (0, 1, 1))})


TWO_BARS = """
mechanism TwoBars {
    design l1 = 1 m +/- 1%;
    design l2 = 1 m +/- 1%;
    gravity 9.81 m/s^2 along -z;
    body one: rod(mass: 1 kg, length: l1, along: -z);
    body two: rod(mass: 1 kg, length: l2, along: -z);
    joint a: revolute(y) from ground to one;
    joint b: revolute(y) from ground to two;
}
"""


def test_equal_modes_split_along_a_direction():
    study = eigentol.Study(eigentol.Mechanism.from_text(TWO_BARS))
    own = math.sqrt(1.5 * G)
    found = study.clusters()
    assert len(found) == 1 and found.modes == [[0, 1]] and found.defective == [False]
    assert found.distances[0] == 0 and "cluster" in repr(found)
    slopes = study.directional_derivatives(0, design={"l1": 1.0})
    assert slopes.modes.tolist() == [0, 1]
    np.testing.assert_allclose(slopes.frequencies, [-own / 2, 0], atol=1e-12)
    both = study.directional_derivatives(1, design=[1.0, -2.0])
    np.testing.assert_allclose((both.eigenvalues @ [1, 1j]).real, [-(own**2), 2 * own**2], atol=1e-11)
    alone = study.replace(design={"l1": 2.0})
    assert len(alone.clusters()) == 0 and alone.clusters().tables == []


def test_ctrl_c_ends_a_run_of_samples(study, request):
    study = study.replace(samples=2_000_000_000)
    # Whoever starts the tests in the background may have Ctrl-C ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    speeds = np.linspace(4.0, 8.0, 3_000_000)
    questions = [
        study.monte_carlo,
        lambda: study.samples_between(0, 1_000_000_000),
        lambda: study.chances(["frequency 1 >= 3.9 rad/s"]),
        lambda: study.campbell("omega", speeds),
        lambda: study.sweep("omega", speeds),
    ]
    for question in questions:
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            question()


def test_chances_of_parts_add_up(study):
    study, wanted = study.replace(samples=1000, tolerances={"l": "10%"}), ["frequency 1 >= 4 rad/s"]
    whole = study.chances(wanted)
    parts = [study.chances(wanted, stop=300), study.chances(wanted, 300)]
    assert [sum(vars(part.all).values()) for part in [*parts, whole]] == [300, 700, 1000]
    assert 0 < whole["met"][0] < 1000
    assert sum(part["met"][0] for part in parts) == whole["met"][0]
    with pytest.raises(eigentol.InvalidValue, match="range"):
        study.chances(wanted, 500, 2000)


FOUR_BAR = """
pub mechanism FourBar {
    gravity 9.81 m/s^2 along -z;
    body a: rod(mass: 1 kg, length: 100 mm, along: x);
    body b: rod(mass: 2 kg, length: 250 mm, along: x);
    body c: rod(mass: 2 kg, length: 200 mm, along: x);
    joint alpha: revolute(-y) from ground to a;
    joint beta:  revolute(-y) from a to b at [100 mm, 0, 0];
    joint gamma: revolute(-y) from ground to c at [250 mm, 0, 0];
    joint pin:   revolute(-y) from b to c at [250 mm, 0, 0], at [200 mm, 0, 0] on c, cut;
    force spring: spring(on: alpha, stiffness: 8 N*m/rad, rest: 80 deg);
}
"""


def test_a_loop_is_assembled_on_the_side_of_its_guess():
    """Where the circles of coupler and rocker meet, on either side of the line between their centres."""
    mechanism = eigentol.Mechanism.from_text(FOUR_BAR)
    modes = []
    for side in (1, -1):
        guess = {"gamma": f"{side * 110} deg", "beta": "-30 deg" if side > 0 else "-120 deg"}
        study = eigentol.Study(mechanism, start={"alpha": "60 deg"}, guess=guess)
        found = study.assembly()
        alpha = math.radians(60)
        tip = 0.1 * np.array([math.cos(alpha), math.sin(alpha)])
        line = np.array([0.25, 0.0]) - tip
        distance = np.hypot(*line)
        along = (distance**2 + 0.25**2 - 0.2**2) / (2 * distance)
        across = side * math.sqrt(0.25**2 - along**2)
        unit = line / distance
        corner = tip + along * unit + across * np.array([-unit[1], unit[0]])
        beta = math.atan2(*(corner - tip)[::-1]) - alpha
        gamma = math.atan2(corner[1], corner[0] - 0.25)
        own = dict(zip(mechanism.unknowns, found.coordinates))
        assert abs(own["alpha"] - alpha) < 1e-12
        for name, expected in (("beta", beta), ("gamma", gamma)):
            turned = math.remainder(own[name] - expected, 2 * math.pi)
            assert abs(turned) < 1e-9, (name, side)
        assert found.held[:3] == [True, False, False] and not found.constraints.singular
        assert 0 < found.margin <= 1 and np.abs(found.gaps).max() < 1e-12
        assert found.moved[0] == 0 and abs(found.moved).max() > 0
        assert found.table()["alpha [rad]"][0] == own["alpha"]
        modes.append(found.mode)
    assert sorted(modes) == ["Negative", "Positive"]
    with pytest.raises(eigentol.NotAssembled):
        eigentol.Study(mechanism, start={"alpha": 0, "beta": 0, "gamma": 0}).assembly()


def test_kernels(pendulum):
    q = [0.4]
    mass, damping, stiffness = pendulum.linear(q, {"omega": 5}, {"l": "1000 mm"})
    inertia = MASS * LENGTH**2 / 3
    np.testing.assert_allclose(mass, [[inertia]])
    expected = MASS * G / 2 * np.cos(0.4) - inertia * 25 * np.cos(0.8)
    np.testing.assert_allclose(stiffness, [[expected]], rtol=1e-12)
    residual = pendulum.residual(q, [5.0])
    torque = MASS * G / 2 * np.sin(0.4) - inertia * 25 * np.sin(0.4) * np.cos(0.4)
    np.testing.assert_allclose(residual, [torque], rtol=1e-12)
    (by_q, by_u, by_b), _, _ = pendulum.linear_partials(q, [5.0])
    assert by_q.shape == (1, 1, 1) and by_u.shape == (1, 1, 1) and by_b.shape == (1, 1, 2)
    np.testing.assert_allclose(by_b[0, 0], [LENGTH**2 / 3, 2 * MASS * LENGTH / 3], rtol=1e-12)
    np.testing.assert_allclose(pendulum.accelerations([0.0], q, [5.0]), -residual / inertia, rtol=1e-12)
    assert pendulum.output_values(q)[0] == 0.4


def test_the_shift_of_the_equilibrium(study):
    sine = np.sqrt(1 - COSINE**2)
    shift = study.equilibrium_shift()
    np.testing.assert_allclose(shift.by_design, [[0.0, COSINE / sine]], rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(shift.by_input, [[2 * COSINE / SPEED / sine]], rtol=1e-10)
    np.testing.assert_allclose(study.outputs().by_design, shift.by_design, rtol=1e-12)
