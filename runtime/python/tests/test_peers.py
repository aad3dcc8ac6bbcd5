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


def test_sigma_by_openturns(study):
    """First order and sampling of OpenTURNS on our response."""
    ot = pytest.importorskip("openturns", reason="OpenTURNS is absent: sigma is not compared")
    study = study.replace(tolerances={"m": "0.2 kg", "l": "3%"})
    response = study.response("frequency", 0)
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
    np.testing.assert_allclose(study.first_order().sigma(), [theirs], rtol=1e-9)

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
