"""Statistics of three mechanisms, ours and those of OpenTURNS through the same evaluations.

`python test_openturns.py` prints the table of the README with times.
"""

import math
import pathlib
import time

import numpy as np
import pytest

import eigentol

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
SAMPLES = 20_000
SOBOL = 4096


def machine(name, **settings):
    mechanism = eigentol.Mechanism.from_file(EXAMPLES / f"{name}.mechanism")
    return eigentol.Study(mechanism, samples=SAMPLES, seed=1, threads=1, **settings)


# A study, the response, and how far below its nominal value the limit state lies, in first-order sigmas.
CASES = {
    "rotating pendulum": (
        lambda: machine(
            "rotating_pendulum", inputs={"omega": 5.0}, start={"theta": 1.0}, tolerances={"l": "10%"}
        ),
        "frequency 1",
        4.0,
    ),
    "rotating double pendulum": (
        lambda: machine(
            "rotating_double_pendulum",
            inputs={"omega": 5.0},
            start={"theta1": 1.0, "theta2": 1.0},
            tolerances={"l": "5%"},
        ),
        "frequency 2",
        4.5,
    ),
    "Jeffcott rotor": (
        lambda: machine("jeffcott_rotor", inputs={"speed": "2000 rpm"}),
        "frequency 3",
        4.5,
    ),
}


class Compared:
    """The same problem in both packages."""

    def __init__(self, ot, case):
        make, self.of, self.sigmas_off = CASES[case]
        self.study = make()
        spread = self.study.sigmas
        varied = [name for name, sigma in zip(self.study.mechanism.design, spread) if sigma > 0]
        self.response = self.study.response(self.of, variables=varied)
        spread = spread[spread > 0]
        self.function = ot.PythonFunction(
            len(varied),
            1,
            func=lambda x: [self.response(x)],
            func_sample=lambda xs: self.response(xs)[:, None],
            gradient=lambda x: self.response.gradient(x)[:, None],
        )
        # Their own steps are one for all units, and make a negative time of a lag.
        steps = ot.Point(0.05 * spread)
        hessian = ot.CenteredFiniteDifferenceHessian(steps, self.function.getEvaluation())
        self.function.setHessian(hessian)
        normal = [ot.Normal(m, s) for m, s in zip(self.response.nominal, spread)]
        self.inputs = ot.JointDistribution(normal)
        gradient = self.response.gradient(self.response.nominal)
        self.sigma = float(np.linalg.norm(gradient * spread))
        self.value = float(self.response(self.response.nominal))
        self.limit = self.value - self.sigmas_off * self.sigma
        vector = ot.CompositeRandomVector(self.function, ot.RandomVector(self.inputs))
        self.event = ot.ThresholdEvent(vector, ot.Less(), self.limit)
        self.varied = varied

    def requirement(self):
        return [f"{self.of} >= {self.limit} rad/s"]


@pytest.fixture(params=CASES)
def compared(request):
    ot = pytest.importorskip("openturns", reason="OpenTURNS is absent: statistics are not compared")
    ot.RandomGenerator.SetSeed(1)
    return ot, Compared(ot, request.param)


def design_point(ot, own):
    """FORM of OpenTURNS."""
    solver = ot.AbdoRackwitz()
    solver.setMaximumAbsoluteError(1e-10)
    solver.setMaximumConstraintError(1e-10)
    solver.setMaximumRelativeError(1e-10)
    solver.setMaximumResidualError(1e-10)
    solver.setStartingPoint(own.inputs.getMean())
    form = ot.FORM(solver, own.event)
    form.run()
    return form.getResult()


def importance(ot, own, point, size):
    """Importance sampling of OpenTURNS about its design point, in the standard space."""
    event = ot.StandardEvent(own.event)
    density = ot.Normal(point, ot.CovarianceMatrix(np.eye(len(point))))
    experiment = ot.ImportanceSamplingExperiment(density)
    algorithm = ot.ProbabilitySimulationAlgorithm(event, experiment)
    algorithm.setMaximumOuterSampling(size)
    algorithm.setMaximumCoefficientOfVariation(0.0)
    algorithm.setBlockSize(1)
    algorithm.run()
    return algorithm.getResult()


def test_distributions(compared):
    ot, own = compared
    theirs = np.array(own.function(own.inputs.getSample(SAMPLES)))[:, 0]
    ours = own.study.replace(keep_samples=True).monte_carlo()
    mode = int(own.of.split()[1]) - 1
    error = own.sigma / math.sqrt(SAMPLES)
    assert abs(ours.mean()[mode] - theirs.mean()) < 4 * math.sqrt(2) * error
    assert abs(ours.sigma()[mode] - theirs.std(ddof=1)) < 4 * error
    # Standard error of the quantile of a normal distribution: sqrt(p (1 - p) / N) / density.
    values = ours.frequencies[:, mode]
    for p in (0.01, 0.5, 0.99):
        density = ot.Normal().computePDF(ot.Normal().computeQuantile(p)) / own.sigma
        allowed = 4 * math.sqrt(2 * p * (1 - p) / SAMPLES) / density
        assert abs(np.quantile(values, p) - np.quantile(theirs, p)) < allowed


def test_sobol_indices(compared):
    ot, own = compared
    ours = own.study.influence([own.of])
    places = [ours["of"].index(name) for name in own.varied]
    algorithm = ot.SaltelliSensitivityAlgorithm(own.inputs, SOBOL, own.function)
    first, total = algorithm.getFirstOrderIndices(), algorithm.getTotalOrderIndices()
    # Their estimates scatter by some two hundredths at this size.
    np.testing.assert_allclose(ours["first"][places], first, atol=0.08)
    np.testing.assert_allclose(ours["total"][places], total, atol=0.08)


def test_design_points_and_a_rare_event(compared):
    ot, own = compared
    ours = own.study.reliability(own.requirement())
    form = design_point(ot, own)
    assert ours["beta"][0] == pytest.approx(form.getHasoferReliabilityIndex(), rel=1e-6)
    assert ours["probability of failure, first order"][0] == pytest.approx(form.getEventProbability(), rel=1e-5)
    found = own.study.probability(own.requirement()).each[0]
    point = form.getStandardSpaceDesignPoint()
    theirs = importance(ot, own, point, 4000)
    error = math.hypot(standard_error(found), theirs.getStandardDeviation())
    assert abs(found.value - theirs.getProbabilityEstimate()) < 4 * error
    assert found.value < 1e-3


def standard_error(found):
    """That of a 95 % interval."""
    return (found.interval.upper - found.interval.lower) / 3.92


def timed(run):
    began = time.perf_counter()
    result = run()
    return result, time.perf_counter() - began


def main():
    import openturns as ot

    print("| mechanism | question | eigentol | OpenTURNS | eigentol, s | OpenTURNS, s |")
    print("| --- | --- | ---: | ---: | ---: | ---: |")
    for case in CASES:
        ot.RandomGenerator.SetSeed(1)
        own = Compared(ot, case)
        mode = int(own.of.split()[1]) - 1

        def row(question, ours, theirs, text):
            (a, s), (b, t) = timed(ours), timed(theirs)
            print(f"| {case} | {question} | {text(a, True)} | {text(b, False)} | {s:.3f} | {t:.3f} |")

        row(
            f"sigma, {SAMPLES} samples",
            lambda: own.study.monte_carlo().sigma()[mode],
            lambda: np.array(own.function(own.inputs.getSample(SAMPLES)))[:, 0].std(ddof=1),
            lambda value, _: f"{value:.5f}",
        )
        row(
            "largest total Sobol index",
            lambda: own.study.influence([own.of])["total"].max(),
            lambda: max(
                ot.SaltelliSensitivityAlgorithm(own.inputs, SOBOL, own.function).getTotalOrderIndices()
            ),
            lambda value, _: f"{value:.3f}",
        )
        row(
            "beta",
            lambda: own.study.reliability(own.requirement()),
            lambda: design_point(ot, own),
            lambda value, mine: f"{value['beta'][0]:.6f}"
            if mine
            else f"{value.getHasoferReliabilityIndex():.6f}",
        )
        point = design_point(ot, own).getStandardSpaceDesignPoint()
        row(
            "rare event",
            lambda: own.study.probability(own.requirement()).each[0],
            lambda: importance(ot, own, point, 4000),
            lambda value, mine: f"{value.value:.3e} +- {standard_error(value):.0e}"
            if mine
            else f"{value.getProbabilityEstimate():.3e} +- {value.getStandardDeviation():.0e}",
        )


if __name__ == "__main__":
    main()
