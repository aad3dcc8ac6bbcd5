"""The same numbers by other people's programs."""

import math

import numpy as np
import pytest

import eigentol


def test_a_rotor_has_the_eigenvalues_of_ross(rotor):
    """Jeffcott's rotor as finite elements: a massless shaft, rigid bearings, a seal at the disk."""
    ross = pytest.importorskip("ross", reason="ROSS is absent: the rotor's eigenvalues are not compared")
    modulus, diameter, near, far, radius, width = 206e9, 0.03, 0.26, 0.32, 0.25, 0.03
    steel = ross.Material(name="massless", rho=1e-3, E=modulus, Poisson=0.3)
    kinds = {"shear_effects": False, "rotary_inertia": False, "gyroscopic": False}
    shaft = [
        ross.ShaftElement(L=length, idl=0, odl=diameter, material=steel, **kinds)
        for length in (near, far)
    ]
    mass = 7850 * math.pi * radius**2 * width
    across, along = mass * (3 * radius**2 + width**2) / 12, mass * radius**2 / 2
    disk = ross.DiskElement(n=1, m=mass, Id=across, Ip=along)
    rigid = {"kxx": 1e13, "kyy": 1e13, "cxx": 0, "cyy": 0}
    bearings = [
        ross.BearingElement(n=0, kzz=1e6, **rigid),
        ross.BearingElement(n=2, **rigid),
        ross.BearingElement(n=1, kxx=150e3, kyy=250e3, cxx=80, cyy=80),
    ]
    theirs = ross.Rotor(shaft, [disk], bearings)
    axial = math.sqrt(1e6 / mass)
    for speed in (0.0, 200.0, 400.0):
        # Damping that turns with the shaft is not among theirs.
        study = eigentol.Study(rotor, inputs={"speed": speed}, design={"lag": 0.0})
        ours = study.modes().state_space_eigenvalues
        found = theirs.run_modal(speed=speed, num_modes=12, sparse=False).evalues
        # Theirs has an axial mode too, and those of the nearly massless shaft.
        size = np.abs(found.imag)
        found = found[(size < 1e4) & (np.abs(size - axial) > 1.0)]
        assert len(found) == len(ours) == 8
        np.testing.assert_allclose(ours.imag, found.imag, rtol=2e-6)
        np.testing.assert_allclose(ours.real, found.real, atol=2e-6 * abs(ours).max())


def film(speed):
    """Curves of the example: their points by hand, between them the natural splines of SciPy."""
    interpolate = pytest.importorskip("scipy.interpolate", reason="SciPy is absent")
    speeds = np.array([2000, 4000, 6000, 8000, 10000, 12000]) * math.pi / 30
    points = {
        "kxx": [12.15e6, 12.39e6, 12.44e6, 12.46e6, 12.47e6, 12.48e6],
        "kxy": [20.39e6, 41.05e6, 61.64e6, 82.21e6, 102.8e6, 123.3e6],
        "kyx": [-26.91e6, -44.58e6, -64.03e6, -84.02e6, -104.2e6, -124.6e6],
        "kyy": [7.513e6, 6.608e6, 6.411e6, 6.34e6, 6.306e6, 6.288e6],
        "cxx": [208.4e3, 199.7e3, 197.9e3, 197.2e3, 196.9e3, 196.7e3],
        "cxy": [-58.17e3, -29.6e3, -19.81e3, -14.88e3, -11.91e3, -9.931e3],
        "cyy": [243.3e3, 209.1e3, 202.1e3, 199.6e3, 198.5e3, 197.8e3],
    }
    points["cyx"] = points["cxy"]
    spline = interpolate.CubicSpline
    return {name: spline(speeds, values, bc_type="natural")(speed) for name, values in points.items()}


def test_a_rotor_on_oil_films_has_the_limit_speed_of_ross(oil_rotor):
    """Oil films with tables of eight coefficients over the speed; the shaft as stiff as their numbers allow."""
    ross = pytest.importorskip("ross", reason="ROSS is absent: oil films are not compared")
    rpm = math.pi / 30
    radius, length, near, far = 0.07, 0.8, 0.3, 0.4
    stiff = ross.Material(name="stiff", rho=1.0, E=5e18, G_s=2e18)
    kinds = {"shear_effects": False, "rotary_inertia": False, "gyroscopic": False}
    shaft = [ross.ShaftElement(L=part, idl=0, odl=0.05, material=stiff, **kinds) for part in (near, far)]
    mass = 7850 * math.pi * radius**2 * length
    across, along = mass * (3 * radius**2 + length**2) / 12, mass * radius**2 / 2
    disk = ross.DiskElement(n=1, m=mass, Id=across, Ip=along)
    # Their splines are others than ours: the tables they get are dense.
    speeds = np.linspace(2000, 12000, 201) * rpm
    bearings = [
        ross.BearingElement(n=node, frequency=speeds, kzz=np.full_like(speeds, axial), **film(speeds))
        for node, axial in ((0, 1e2), (2, 0.0))
    ]
    theirs = ross.Rotor(shaft, [disk], bearings)

    def by_ross(speed):
        found = theirs.run_modal(speed=speed, num_modes=24, sparse=False).evalues
        # Theirs also slides along its axis and turns about it, both slowly, and bends far beyond these.
        size = np.abs(found)
        return np.sort_complex(found[(size > 20) & (size < 2e4) & (found.imag >= 0)])

    def ours(speed):
        found = eigentol.Study(oil_rotor, inputs={"speed": speed}).modes().state_space_eigenvalues
        return np.sort_complex(found[found.imag >= 0])

    for speed in np.array([2000, 5200, 8000, 12000]) * rpm:
        np.testing.assert_allclose(ours(speed), by_ross(speed), rtol=1e-4)

    study = eigentol.Study(oil_rotor, inputs={"speed": 6000 * rpm})
    (limit,) = study.flutter_onsets("speed", 2000 * rpm, 12000 * rpm).entries
    stable, unstable = 0.995 * limit.value, 1.005 * limit.value
    growth = [max(by_ross(speed).real) for speed in (stable, unstable)]
    assert growth[0] < 0 < growth[1]
    # So near to it growth is a straight line, which crosses zero at their limit.
    crossing = stable - growth[0] * (unstable - stable) / (growth[1] - growth[0])
    np.testing.assert_allclose(limit.value, crossing, rtol=1e-4)

    # What grows goes forward, by theirs and by ours.
    modal = theirs.run_modal(speed=unstable, num_modes=24, sparse=False)
    growing = [k for k, s in enumerate(modal.evalues[: len(modal.wn)]) if s.real > 0.1 and abs(s) > 20]
    assert [modal.whirl_direction()[k] for k in growing] == ["Forward"]
    beyond = eigentol.Study(oil_rotor, inputs={"speed": unstable})
    found = zip(beyond.modes().eigenvalues, beyond.whirls())
    (whirl,) = [whirl for s, whirl in found if s.real > 0.1]
    assert whirl > 0


def test_sigma_by_openturns(study):
    """First order and sampling of OpenTURNS on our response."""
    ot = pytest.importorskip("openturns", reason="OpenTURNS is absent: sigma is not compared")
    study = study.replace(tolerances={"m": "0.2 kg", "l": "3%"})
    response = study.response("frequency 1")
    function = ot.PythonFunction(
        len(response.names),
        1,
        func=lambda x: [response(x)],
        func_sample=lambda xs: response(xs)[:, None],
        gradient=lambda x: response.gradient(x)[:, None],
    )
    mean, sigma = response.nominal, study.sigmas
    inputs = ot.JointDistribution([ot.Normal(m, s) for m, s in zip(mean, sigma)])
    inputs.setDescription(response.names)

    # Their differences of our values are our gradient.
    differences = ot.CenteredFiniteDifferenceGradient(ot.Point([1e-5] * 2), function.getEvaluation())
    by_them = np.array(differences.gradient(mean))[:, 0]
    np.testing.assert_allclose(response.gradient(mean), by_them, rtol=1e-6, atol=1e-8)

    # First order.
    vector = ot.CompositeRandomVector(function, ot.RandomVector(inputs))
    theirs = math.sqrt(ot.TaylorExpansionMoments(vector).getCovariance()[0, 0])
    np.testing.assert_allclose(study.first_order()["sigma of frequency"], [theirs], rtol=1e-9)

    # Sampling.
    ot.RandomGenerator.SetSeed(1)
    size = 20_000
    values = np.array(function(inputs.getSample(size)))[:, 0]
    ours = study.replace(samples=size).monte_carlo()
    # Relative standard error of a standard deviation: 1 / sqrt(2 N) for each of the two.
    error = math.sqrt(2) * theirs / math.sqrt(2 * size)
    assert abs(values.std(ddof=1) - ours.sigma()[0]) < 4 * error
    assert abs(values.mean() - ours.mean()[0]) < 4 * math.sqrt(2) * theirs / math.sqrt(size)


def test_tables_are_taken_by_pandas(study):
    pandas = pytest.importorskip("pandas", reason="pandas is absent: it is not given a table")
    frame = pandas.DataFrame(study.sweep("omega", [4.0, 5.0]).table())
    assert len(frame) == 2 and np.isfinite(frame["frequency 1 [rad/s]"]).all()


def test_tables_are_taken_by_polars(study):
    polars = pytest.importorskip("polars", reason="polars is absent: it is not given a table")
    found = study.replace(samples=50, keep_samples=True).monte_carlo()
    for name in found.tables:
        frame = polars.DataFrame(found.table(name))
        assert frame.height == len(next(iter(found.table(name).values())))
