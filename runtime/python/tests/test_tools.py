"""The same mechanism in OpenMDAO, JAX and PyTorch: the same numbers, exact derivatives, and the time beside finite differences.

Where one of them is absent, its test says so.
"""

import time

import numpy as np
import pytest

import eigentol

TEXT = """mechanism Pendulum {
    input omega: rad/s;
    design l = 1 m +/- 3%;
    design m = 3 kg +/- 1%;
    design k = 2 N*m +/- 5%;
    gravity 9.81 m/s^2 along -z;
    body shaft: massless;
    body bar: rod(mass: m, length: l, along: -z);
    joint spin: revolute(z) from ground to shaft, driven at omega;
    joint theta: revolute(y) from shaft to bar;
    force hold: spring(on: theta, stiffness: k);
    output angle = theta;
}"""


@pytest.fixture(scope="module")
def study():
    return eigentol.Study(eigentol.Mechanism.from_text(TEXT), inputs={"omega": 5.0}, start={"theta": 1.0})


@pytest.fixture(scope="module")
def designs(study):
    generator = np.random.default_rng(5)
    return study.design * (1 + 0.02 * generator.standard_normal((2, 3, 3)))


def seconds(work):
    began = time.perf_counter()
    work()
    return time.perf_counter() - began


def differences(response, x):
    """Central differences, as one would take without derivatives."""
    steps = 1e-6 * np.abs(x)
    return np.array([(response(x + h) - response(x - h)) / (2 * h.max()) for h in np.diag(steps)])


def test_jax(study, designs):
    jax = pytest.importorskip("jax", reason="JAX is absent")
    jax.config.update("jax_enable_x64", True)
    response = study.response("frequency 1")
    f = response.jax()
    rows = designs.reshape(-1, 3)
    values, slopes = response(rows), response.gradient(rows)
    same = lambda a, b: np.testing.assert_allclose(np.asarray(a), b, rtol=1e-12)
    same(f(designs), values.reshape(2, 3))
    same(jax.jit(f)(rows[0]), values[0])
    same(jax.vmap(jax.grad(f))(rows), slopes)
    same(jax.grad(f)(rows[0]), slopes[0])
    same(jax.jacfwd(f)(rows[0]), slopes[0])
    same(jax.vmap(jax.vmap(f))(designs), values.reshape(2, 3))
    same(jax.jvp(f, (rows[0],), (np.ones(3),))[1], slopes[0].sum())
    chained = jax.grad(lambda x: (f(x) - 4.0) ** 2)(rows[0])
    same(chained, 2 * (values[0] - 4.0) * slopes[0])
    times = seconds(lambda: jax.grad(f)(rows[0])), seconds(lambda: differences(f, rows[0]))
    print(f"JAX: gradient {1e3 * times[0]:.2f} ms, by differences {1e3 * times[1]:.2f} ms")


def test_torch(study, designs):
    torch = pytest.importorskip("torch", reason="PyTorch is absent")
    response = study.response("frequency 1")
    f = response.torch()
    rows = designs.reshape(-1, 3)
    x = torch.tensor(designs, requires_grad=True)
    value = f(x)
    np.testing.assert_allclose(value.detach().numpy(), response(rows).reshape(2, 3), rtol=1e-12)
    (value**2).sum().backward()
    expected = 2 * response(rows)[:, None] * response.gradient(rows)
    np.testing.assert_allclose(x.grad.numpy(), expected.reshape(2, 3, 3), rtol=1e-12)
    # A length that gives a frequency, by a few steps of an optimiser of PyTorch.
    target = 1.02 * float(response(rows[0]))
    scale = torch.ones(1, dtype=torch.float64, requires_grad=True)
    optimiser = torch.optim.LBFGS([scale], tolerance_grad=1e-12, tolerance_change=1e-16, line_search_fn="strong_wolfe")
    base = torch.tensor(rows[0])

    def loss():
        optimiser.zero_grad()
        own = (f(base * torch.cat([scale, torch.ones(2, dtype=torch.float64)])) - target) ** 2
        own.backward()
        return own

    optimiser.step(loss)
    found = float(f(base * torch.tensor([scale.item(), 1.0, 1.0], dtype=torch.float64)))
    assert abs(found - target) < 1e-8 * target


def test_openmdao(study):
    om = pytest.importorskip("openmdao.api", reason="OpenMDAO is absent")
    problem = om.Problem(reports=None)
    outputs = {"first": "frequency 1", "lean": "angle"}
    problem.model.add_subsystem("machine", study.openmdao(outputs), promotes=["*"])
    problem.model.add_design_var("l", lower=0.5, upper=2.0)
    problem.model.add_design_var("k", lower=0.5, upper=5.0)
    problem.model.add_constraint("first", lower=4.6)
    problem.model.add_objective("lean", scaler=-1.0)
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-10, disp=False)
    problem.setup()
    problem.run_model()
    np.testing.assert_allclose(problem.get_val("first"), study.modes().frequencies[:1], rtol=1e-12)
    exact = problem.compute_totals(["first", "lean"], ["l", "m", "k"])
    for name, text in outputs.items():
        gradient = study.response(text).gradient(study.design)
        got = [exact[name, variable].item() for variable in ("l", "m", "k")]
        np.testing.assert_allclose(got, gradient, rtol=1e-12, atol=1e-15)
    check = problem.check_partials(out_stream=None, method="fd", form="central", step_calc="rel_avg")
    for own in check["machine"].values():
        assert np.abs(own["J_fwd"] - own["J_fd"]).max() < 1e-5
    assert not problem.run_driver().success is False
    assert problem.get_val("first").item() >= 4.6 - 1e-6
    # A design that stands nowhere is refused by the error from which drivers go back.
    problem.set_val("k", -1e3)
    with pytest.raises(om.AnalysisError):
        problem.run_model()


def test_names_of_instances_are_inputs():
    om = pytest.importorskip("openmdao.api", reason="OpenMDAO is absent")
    text = """mechanism Pair {
        design m[0..2] = 2 kg; body b[0..2]: rod(mass: 1 kg, length: 1 m, along: x);
        for i in 0..2 { joint x[i]: prismatic(x) from ground to b[i];
            force f[i]: spring(on: x[i], stiffness: (8 + i) * m[i] * 1 N/m / 1 kg); }
    }"""
    study = eigentol.Study(eigentol.Mechanism.from_text(text))
    problem = om.Problem(reports=None)
    problem.model.add_subsystem("pair", study.openmdao({"f": "frequency 2"}))
    problem.setup()
    problem.run_model()
    assert problem.get_val("pair.m_1").item() == 2.0
    assert problem.get_val("pair.f").item() == pytest.approx(study.modes().frequencies[1])
