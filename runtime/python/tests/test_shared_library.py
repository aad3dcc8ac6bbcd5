"""`examples/shared_library` as CasADi and an FMI importer call it: the same numbers as those of the module.

Where one of them or cargo is absent, its test says so.
"""

import os
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

import eigentol

PACKAGE = Path(__file__).resolve().parents[3] / "examples" / "shared_library"
SPEED = 1000 * np.pi / 30
# Of the declared units, SI.
SCALES = {"rpm": np.pi / 30, "kN/mm": 1e6, "um": 1e-6}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    if shutil.which("cargo") is None:
        pytest.skip("cargo is absent")
    folder = tmp_path_factory.mktemp("shared")
    target = Path(os.environ.get("CARGO_TARGET_DIR", PACKAGE.parents[1] / "target")) / "shared"
    fmu = folder / "rotor.fmu"
    # Its lock file is that of the project, so that nothing new is looked for.
    shutil.copy(PACKAGE.parents[1] / "Cargo.lock", PACKAGE)
    run = ["cargo", "run", "--quiet", "--manifest-path", PACKAGE / "Cargo.toml", "--bin", "fmu", "--", fmu]
    subprocess.run(run, check=True, env={**os.environ, "CARGO_TARGET_DIR": str(target)})
    built = (target / "debug" / "deps").glob("*rotor.*")
    library = next(path for path in built if path.suffix in {".so", ".dylib", ".dll"})
    return library, fmu


@pytest.fixture(scope="module")
def study():
    mechanism = eigentol.Mechanism.from_file(PACKAGE / "rotor.mechanism")
    return eigentol.Study(mechanism, inputs={"speed": SPEED})


def expected(study):
    """Values and derivatives in the order of the library, SI."""
    texts = [f"{name} {mode}" for mode in (1, 2) for name in ("frequency", "damping_ratio")]
    texts += study.mechanism.outputs + [f"vibration {name}" for name in study.mechanism.outputs]
    responses = [study.response(text) for text in texts]
    values = [response(study.design) for response in responses]
    return np.array(values), np.array([response.gradient(study.design) for response in responses])


def close(a, b):
    np.testing.assert_allclose(np.asarray(a, float), b, rtol=1e-12, atol=1e-15)


def test_casadi(built, study):
    casadi = pytest.importorskip("casadi", reason="CasADi is absent")
    f = casadi.external("rotor", str(built[0]))
    x = np.concatenate([study.inputs, study.design])
    values, rows = expected(study)
    close(np.array(f(x)).ravel(), values)
    jacobian = f.jacobian()
    own = np.array(jacobian(x, f(x)))
    close(own[:, 1:], rows)
    began = time.perf_counter()
    for _ in range(100):
        jacobian(x, 0)
    exact = time.perf_counter() - began
    began = time.perf_counter()
    steps = np.diag(1e-6 * np.abs(x))
    for _ in range(100):
        by_differences = np.array([(np.array(f(x + h)) - np.array(f(x - h))).ravel() / (2 * h.max()) for h in steps]).T
    differences = time.perf_counter() - began
    print(f"CasADi: Jacobian {10 * exact:.3f} ms, by differences {10 * differences:.3f} ms")
    scale = np.abs(own).max(axis=1, keepdims=True)
    assert np.abs(own - by_differences)[:, 1:].max() < 1e-4 * scale.max()

    # The least stiffness with which the frequencies are 1.1 and 1.3 times the first one of now, at an amplitude of at most 20 um.
    share = casadi.MX.sym("share", 5)
    y = f(casadi.vertcat(SPEED, share * study.design))
    frequency = values[0]
    problem = {
        "x": share,
        "f": share[1] + share[2],
        "g": casadi.vertcat(y[0] / frequency, y[2] / frequency, y[6] / 20e-6),
    }
    options = {"ipopt": {"print_level": 0, "hessian_approximation": "limited-memory", "tol": 1e-9}, "print_time": False}
    solver = casadi.nlpsol("solver", "ipopt", problem, options)
    low, high = [1, 0.5, 0.5, 1, 1], [1, 4, 4, 1, 1]
    found = solver(x0=np.ones(5), lbx=low, ubx=high, lbg=[1.1, 1.3, -np.inf], ubg=[np.inf, np.inf, 1.0])
    assert solver.stats()["success"], (solver.stats()["return_status"], found)
    best = study.design * np.array(found["x"]).ravel()
    there = study.replace(design=dict(zip(study.mechanism.design, best)))
    assert there.modes().frequencies == pytest.approx([1.1 * frequency, 1.3 * frequency], rel=1e-6)


def test_fmu(built, study):
    fmpy = pytest.importorskip("fmpy", reason="FMPy is absent")
    from fmpy.fmi3 import FMU3Model, FMU3Slave

    fmu = str(built[1])
    description = fmpy.read_model_description(fmu, validate=True)
    references = {own.name: own.valueReference for own in description.modelVariables}
    values, rows = expected(study)
    units = {own.name: own.unit for own in description.modelVariables}
    assert units["speed"] == "rpm" and units["e"] == "um"
    folder = fmpy.extract(fmu)
    try:
        for kind, own in ((FMU3Model, description.modelExchange), (FMU3Slave, description.coSimulation)):
            instance = kind(
                guid=description.guid,
                unzipDirectory=folder,
                modelIdentifier=own.modelIdentifier,
                instanceName="one",
            )
            instance.instantiate()
            instance.enterInitializationMode()
            instance.exitInitializationMode()
            outputs = [own for own in description.modelVariables if own.causality == "output"]
            answers = [own.valueReference for own in outputs]
            scales = np.array([SCALES.get(own.unit, 1.0) for own in outputs])
            close(np.array(instance.getFloat64(answers)) * scales, values)
            for k, name in enumerate(study.mechanism.design):
                slope = instance.getDirectionalDerivative(answers, [references[name]], [1.0])
                unit = SCALES.get(units[name], 1.0)
                close(np.array(slope) * scales / unit, rows[:, k])
            slope = instance.getAdjointDerivative([answers[0]], [references["m"], references["k_up"]], [1.0], 2)
            close(np.array(slope) / [1.0, SCALES["kN/mm"]], rows[0, [0, 2]])
            # Another mass, in its unit.
            instance.setFloat64([references["m"]], [15.0])
            moved = study.replace(design={"m": "15 kg"}).modes().frequencies[0]
            close(instance.getFloat64([answers[0]]), moved)
            # No machine has this mass; it says so, and goes on.
            instance.setFloat64([references["m"]], [-1.0])
            with pytest.raises(Exception, match="(?i)discard|fmi3GetFloat64"):
                instance.getFloat64([answers[0]])
            instance.reset()
            close(np.array(instance.getFloat64(answers)) * scales, values)
            instance.terminate()
            instance.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    result = fmpy.simulate_fmu(fmu, start_values={"e": 40.0}, output=["frequency_1", "amplitude of across"], stop_time=1)
    close(result["frequency_1"][-1], values[0])
