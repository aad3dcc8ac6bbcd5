"""What all results have in common: attributes for every number that they hold, pickling, one orientation of arrays."""

import inspect
import json
import pickle

import numpy as np
import pytest

import eigentol

CLASSES = {
    name: own
    for name, own in vars(eigentol).items()
    if inspect.isclass(own) and not issubclass(own, BaseException)
}


def with_tables(results):
    return {name: own for name, own in results.items() if hasattr(own, "tables")}


def test_no_class_is_forgotten(results):
    assert set(results) == set(CLASSES)


@pytest.mark.parametrize("name", CLASSES)
def test_every_object_pickles(results, name):
    own = results[name]
    again = pickle.loads(pickle.dumps(own))
    assert type(again) is type(own) and repr(again) == repr(own)
    if hasattr(own, "to_json"):
        assert again.to_json() == own.to_json()
    if hasattr(own, "tables"):
        assert again == own and again._repr_html_() == own._repr_html_()
        assert again.operating_point == own.operating_point and again.mechanism == own.mechanism


def test_notes_are_the_sentences_of_the_text(results, study):
    for own in with_tables(results).values():
        assert all(f"  {note}\n" in repr(own) for note in own.notes)
    assert study.clusters().notes == ["tolerances bring no modes together"]


def test_functions_pickle_too(results):
    response, motion = results["Response"], results["Motion"]
    again = pickle.loads(pickle.dumps(response))
    assert again.names == response.names == ["l"] and again([0.9]) == response([0.9])
    again = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(again(0.0, [0.3, 0.1]), motion(0.0, [0.3, 0.1]))


def test_exceptions_of_other_processes_keep_their_places():
    with pytest.raises(eigentol.DeclarationError) as caught:
        eigentol.Mechanism.from_text("mechanism Wrong { body }")
    again = pickle.loads(pickle.dumps(caught.value))
    assert [own.line for own in again.mistakes] == [1]


def test_results_that_differ_are_not_equal(results, study):
    assert study.modes() == study.modes() and study.modes() != results["Modes"]
    assert study.modes() != study.equilibrium()


def test_only_a_document_of_the_same_kind_is_read(results):
    with pytest.raises(eigentol.InvalidValue, match="modes"):
        eigentol.Equilibrium.from_json(results["Modes"].to_json())
    with pytest.raises(eigentol.InvalidValue):
        eigentol.Modes.from_json("{")


# Where a field of the Rust type is found that has another name; an attribute for a whole branch of fields, a text in
# round brackets for what is no result. Fields of the same name need no entry.
COUNTED = {"counts": "counts"}
RESPONSES = {"wanted": "names"}
PEAKS = {"place": "places", "frequency": "frequencies", "height": "heights", "amplification": "amplifications"}
SPREAD = {"variance_shares": "shares", "by_design": "gradient"}
ELSEWHERE = {
    "Equilibrium": {
        "constraints.dependent": "dependent_constraints",
        "free.motions": "free",
        "free.held": "held",
        "free.balances": "(for the solvers)",
        "free.columns": "(for the solvers)",
        "free.rows": "(for the solvers)",
    },
    "Assembly": {"constraints.dependent": "dependent_constraints"},
    "Modes": {
        "modes.s": "eigenvalues",
        "modes.lambda": "lambdas",
        "modes.shape": "shapes",
        "modes.left": "left_shapes",
        "modes.behaviour": "behaviours",
        "modes.residual": "residuals",
        "modes.error": "errors",
        "modes.condition": "conditions",
        "modes.label": "labels",
    },
    "Sensitivities": {
        "modes.lambda.by_design": "lambda_by_design",
        "modes.lambda.by_input": "lambda_by_input",
        "modes.general": "by_design",
        "modes.undamped": "family",
        "modes.value": "(the eigenvalue in Modes)",
    },
    "ModeCurvature": {
        "s": "eigenvalue",
        "eigenvalue": "hessian",
        "first.general": "gradient",
        "first.lambda": "gradient",
        "first.value": "eigenvalue",
        "first.undamped": "(the family in Modes)",
        "lambda": "hessian",
    },
    "OutputCurvature": {
        "first.by_design": "gradient",
        "first.by_input": "gradient_by_input",
        "second.by_design": "hessian",
    },
    "EventCurvature": {"first": "gradient", "second": "hessian"},
    "ForcedResponse": {
        "harmonics.frequency": "frequencies",
        "harmonics.shares.excitation": "excitations",
    },
    "ForcedSensitivities": {
        "response": "response",
        "harmonics.frequency.by_design": "frequency_by_design",
        "harmonics.frequency.by_input": "frequency_by_input",
    },
    "ForcedCurvature": {
        "first": "first",
        "harmonics.frequency.by_design": "frequency_hessian",
        "harmonics.frequency.by_input": "frequency_by_input",
        "harmonics.frequency.by_input_and_design": "frequency_by_input_and_design",
        "harmonics.outputs.by_design": "hessian",
    },
    "Bode": {
        "banded": "banded",
        "points.bands.checks.samples": "checked",
        "points.bands.checks.sigma": "sigma_errors",
        "points.bands.checks.upper": "upper_errors",
        "points.bands.spread": "spreads",
        "points.value": "values",
        "points.vibration": "vibrations",
    },
    "Peaks": {
        **{f"peaks.{name}.value": name_of for name, name_of in PEAKS.items()},
        **{f"peaks.{name}.by_design": f"{name_of}_by_design" for name, name_of in PEAKS.items()},
        **{f"peaks.{name}.spread.sigma": f"{name}_sigmas" for name in PEAKS},
        **{
            f"peaks.{name}.spread.{field}": "(follows from the derivatives)"
            for name in PEAKS
            for field in ("mean", "band", "by_design", "variance_shares")
        },
        "peaks.half_power": "half_power_after",
        "peaks.phase": "phases",
        "peaks.equilibrium": "(the equilibrium at that value)",
        "vibration": "(as asked)",
        "range": "(as asked)",
        "states": "(how it was found)",
        "gaps": "(in the text)",
        "sigma_level": "(of the study)",
    },
    "Separation": {
        "peaks": "peaks",
        "margins.actual.value": "margins",
        "margins.actual.by_design": "margins_by_design",
        "margins.actual.spread.sigma": "margin_sigmas",
        **{
            f"margins.actual.spread.{field}": "(follows from the derivatives)"
            for field in ("mean", "band", "by_design", "variance_shares")
        },
        "margins.required": "required",
    },
    "OutputTolerances": {f"spreads.{field}": name for field, name in SPREAD.items()},
    "FirstOrder": {
        "modes.behaviour": "behaviours",
        "modes.distance_to_critical": "distances_to_critical",
        "modes.distance_to_instability": "distances_to_instability",
        "modes.distance_to_neighbour": "distances_to_neighbour",
        "modes.general": "sigma",
        "modes.shift": "mean",
        "modes.value": "(the eigenvalue in Modes)",
        **{f"modes.lambda.{field}": name for field, name in SPREAD.items()},
    },
    "SecondOrder": {f"modes.{name}": "sigma" for name in ("frequency", "natural_frequency", "damping_ratio")},
    "Summary": {
        "first": "first",
        "second": "second",
        "clusters": "clusters",
        "sampling.other_branch": "on_another_branch",
        "sampling.outcomes": "outcomes",
        "trust.advice": "use_instead",
        "trust.mode": "(the place in the list)",
        "trust.checks": "sampled_sigma",
    },
    "MonteCarlo": {
        "all.design": "designs",
        "all.outcome": "outcomes",
        "left_nominal_branch": "on_another_branch",
        "ranges": "ranges",
        **{
            f"{quantity}.{field}": name
            for quantity in ("modes", "damping_ratios")
            for field, name in {"max": "greatest", "min": "least", "sketch": "quantile"}.items()
        },
        **COUNTED,
    },
    "Propagation": {
        "method": "method",
        "spreads.mean": "mean_error",
        "spreads.quantiles": "quantile_errors",
        "spreads.sigma": "sigma_error",
        "spreads.skewness": "skewness_error",
        "with_design": "covariance_with_design",
        **RESPONSES,
        **COUNTED,
    },
    "Influence": {
        "wanted": "responses",
        "responses.variables.variable": "names",
        "responses.variables.first": "first_interval",
        "responses.variables.total": "total_interval",
        **COUNTED,
    },
    "WorstCase": {
        "responses.greatest.design": "greatest_designs",
        "responses.least.design": "least_designs",
        "responses.greatest.value": "greatest",
        "responses.least.value": "least",
        **RESPONSES,
    },
    "Chances": {"all": "all_counts", **COUNTED},
    "Probabilities": {
        "each.by": "found_by",
        "each.interval": "lower",
        "each.value": "failure",
        "any.by": "any_found_by",
        "any.designs": "any_designs",
        "any.interval": "any_interval",
        "any.untold": "any_untold",
        "any.value": "any_failure",
        "chances": "chances",
        "reliability": "reliability",
        **RESPONSES,
    },
    "Reliability": {
        "judgement": "any_judgement",
        "limits.design_points": "design_points",
        "limits.judgement": "judgements",
        "limits.limit": "edges",
        "limits.requirement": "limits",
    },
    "Allocation": {"chances": "chances", "reliability": "reliability"},
    "Clusters": {
        "distance": "distances",
        "mean": "mean_eigenvalues",
        "spread.frequency": "mean",
        "spread.lambda": "mean",
        "spread.growth": "mean",
        "spread.damping_ratio": "mean",
    },
    "Sweep": {
        "points.equilibrium": "equilibria",
        "points.modes": "modes",
        "points.value": "values",
        "searched": "searched",
        "critical": "critical",
        "flutter_onsets": "flutter_onsets",
    },
    "Campbell": {
        "points.equilibrium": "equilibria",
        "points.modes": "eigenvalues",
        "points.value": "values",
        "orders": "orders",
        "searched": "searched",
        "critical": "critical",
        "crossings": "crossings",
        "not_excited": "not_excited",
        "flutter_onsets": "flutter_onsets",
    },
    "Branches": {"branches": "branches"},
    "Convergence": {"changes.answer": "names", "changes.value": "values", "changes.relative": "changes", "without_peaks": "without_peaks"},
    "Branch": {
        "points.equilibrium": "equilibria",
        "points.tangent": "tangents",
        "points.input_tangent": "input_tangents",
        "points.value": "values",
        "special.equilibrium": "special_equilibria",
        "special.kind": "special",
        "special.value": "special",
        "special.v": "critical_vectors",
        "special.w": "left_critical_vectors",
    },
    "Event": {"event": "kind", **{f"spread.{field}": name for field, name in {**SPREAD, "mean": "value"}.items()}},
}


def fields(value, path=()):
    """Paths of the fields of a document; the names of variants and the places in lists are left out."""
    if isinstance(value, list):
        for own in value:
            if isinstance(own, (dict, list)):
                yield from fields(own, path)
    elif isinstance(value, dict):
        for name, own in value.items():
            if name == "description":
                continue
            here = path if name[0].isupper() else (*path, name)
            deeper = list(fields(own, here))
            yield from deeper or [here]


@pytest.mark.parametrize("name", CLASSES)
def test_every_field_of_the_rust_type_is_an_attribute(results, name):
    own = results[name]
    if not hasattr(own, "tables"):
        pytest.skip("it has no document")
    elsewhere, used = {"inputs": "operating_point", **ELSEWHERE.get(name, {})}, set()
    for path in set(fields(json.loads(own.to_json())["result"])):
        prefixes = [".".join(path[:k]) for k in range(1, len(path) + 1)]
        known = [prefix for prefix in prefixes if prefix in elsewhere]
        attribute = elsewhere[known[0]] if known else path[-1]
        used.update(known[:1])
        assert attribute.startswith("(") or hasattr(own, attribute), f"{name}: {'.'.join(path)}"
    assert set(elsewhere) - used <= {"inputs"}, f"{name} has no such fields"


def test_attributes_say_what_tables_say(results):
    """Verdicts and numbers that once stood in tables only."""
    summary, first = results["Summary"], results["FirstOrder"]
    assert summary.trusted_modes.tolist() == summary.table("summary")["trusted"]
    assert summary.use_instead == summary.table("summary")["use"]
    np.testing.assert_array_equal(summary.sampled_sigma(), summary.table("summary")["sigma, sampled [rad/s]"])
    assert first.trusted == all(first.trusted_modes) and first.clustered.tolist() == first.table()["cluster"]
    samples = results["MonteCarlo"]
    np.testing.assert_array_equal(samples.skewness(), samples.table()["skewness of frequency"])
    np.testing.assert_allclose(samples.quantile(0.5), np.median(samples.frequencies), rtol=1e-2)
    assert samples.least() <= samples.quantile(0.01) < samples.quantile(0.99) <= samples.greatest()
    with pytest.raises(eigentol.InvalidValue, match="between 0 and 1"):
        samples.quantile(1.5)
    spreads = results["Propagation"]
    np.testing.assert_array_equal(spreads.skewness, spreads.table()["skewness"])
    points = results["Reliability"]
    assert points.verified == points.table()["verified"]
    np.testing.assert_array_equal(points.importance.ravel(), points.table("design point variables")["importance"])
    chances = results["Chances"]
    np.testing.assert_array_equal(chances.lower, chances.table()["95 % from"])
    (members,) = results["Clusters"].sigma()
    table = results["Clusters"].table("clusters")
    np.testing.assert_array_equal(members, np.array(table["sigma of member"])[: len(members)])


def test_an_event_says_what_it_is(results):
    assert (results["Event"].kind, results["Event"].mode) == ("critical", None)
    assert results["Event"].input == "speed" and results["Event"].shares.tolist() == [1.0]
    diagram = results["Campbell"]
    for event in diagram.crossings:
        assert (event.kind, event.order) == ("crossing", 1.0) and event.mode is not None
        assert event.mode_kind == "blade" and event.whirl is None
    assert all(set(kinds) <= {"blade", None} for kinds in diagram.kinds) and diagram.not_excited == []


TWO = """
mechanism Two {
    design k = 90 N/m +/- 5%;
    design c = 40 N/m;
    design m = 1 kg;
    body left: point(mass: m);
    body right: point(mass: 3 kg);
    joint x: prismatic(x) from ground to left;
    joint y: prismatic(x) from left to right;
    force first: spring(on: x, stiffness: k);
    force second: spring(on: y, stiffness: c);
}
"""


@pytest.fixture(scope="module")
def two():
    return eigentol.Study(eigentol.Mechanism.from_text(TWO))


def test_a_mode_is_a_row(two):
    modes, state = two.modes(), two.equilibrium()
    for eigenvalue, shape, left in zip(modes.lambdas, modes.shapes, modes.left_shapes, strict=True):
        pencil = state.stiffness - eigenvalue * state.mass
        np.testing.assert_allclose(pencil @ shape, 0.0, atol=1e-10)
        np.testing.assert_allclose(left @ pencil, 0.0, atol=1e-10)
        np.testing.assert_allclose(shape.conj() @ state.mass @ shape, 1.0, rtol=1e-12)
    assert two.sensitivities().by_design.shape == two.first_order().gradient().shape == (2, 3)


def test_a_variable_is_the_last_axis(two):
    step = 1e-4
    for mode in range(2):
        found = two.shape_sensitivity(mode)
        assert found.right_by_design.shape == (2, 3) and found.right_by_input.shape == (2, 0)
        for place, (name, value) in enumerate(two.mechanism.nominal.items()):
            ends = [
                two.replace(design={name: value + side}).modes().shapes[mode] for side in (step, -step)
            ]
            slope = (ends[0] - ends[1]) / (2 * step)
            np.testing.assert_allclose(found.right_by_design[:, place], slope, atol=1e-7)
        table = found.table()
        expected = found.right_by_design.real
        np.testing.assert_allclose(table["Re shape [per unit]"], expected.ravel(), rtol=1e-12)


def test_missing_numbers_are_nan(results, two):
    over = eigentol.Study(
        eigentol.Mechanism.from_text(TWO.replace("force second", "force pot: damper(on: y, damping: 500 N*s/m);\n    force second"))
    )
    modes = over.modes()
    missing = np.isnan(modes.frequencies)
    assert missing.any() and not missing.all()
    np.testing.assert_array_equal(np.isnan(over.whirls()), np.full(len(modes), True))
    for own in (over.sensitivities().of("frequency")[1], over.first_order().gradient()):
        np.testing.assert_array_equal(np.isnan(own).all(axis=1), missing)
    np.testing.assert_array_equal(np.isnan(over.second_order().sigma()), missing)
    for own in with_tables(results).values():
        for name in own.tables:
            for heading, column in own.table(name).items():
                numbers = any(isinstance(entry, (int, float)) and not isinstance(entry, bool) for entry in column)
                assert isinstance(column, np.ndarray) or not numbers, (name, heading)


LOOP = """
mechanism Loop {
    design l = 1 m;
    gravity 9.81 m/s^2 along -z;
    body left: rod(mass: 1 kg, length: l, along: -z);
    body right: rod(mass: 1 kg, length: l, along: -z);
    joint a: revolute(y) from ground to left;
    joint b: revolute(y) from ground to right at [0.5 m, 0 m, 0 m];
    constraint gear: coupling(of: b, with: a, ratio: -1);
}
"""


def test_reactions_do_not_count_as_coordinates():
    mechanism = eigentol.Mechanism.from_text(LOOP)
    assert mechanism.coordinates == ["a", "b"] and mechanism.speeds == []
    assert len(mechanism.reactions) == 1
    assert mechanism.unknowns == mechanism.coordinates + mechanism.reactions
    assert "coordinates: a, b\n" in repr(mechanism)
    study = eigentol.Study(mechanism)
    assert study.equilibrium().coordinates.shape == (len(mechanism.unknowns),)
    assert study.equilibrium().freedom == 1


def test_percentages_follow_the_value_where_they_say_so(two):
    """Per cent of a setting are of the value that is set, per cent of the declaration of the declared one."""
    assert two.sigmas[0] == pytest.approx(90 * 0.05 / 3)
    assert two.replace(design={"k": 60.0}).sigmas[0] == pytest.approx(90 * 0.05 / 3)
    for text, width in {"5%": 0.1, "+4% -2%": 0.06}.items():
        given = two.replace(tolerances={"k": text})
        assert given.sigmas[0] == pytest.approx(90 * width / 6)
        assert given.replace(design={"k": 60.0}).sigmas[0] == pytest.approx(60 * width / 6)


def test_beams_with_more_coordinates(results, study):
    found = results["Convergence"]
    assert found.names == [f"frequency {k}" for k in range(1, 6)]
    assert found.changes.shape == (5, 2) and abs(found.changes[0]).max() < 1e-6
    assert found.without_peaks is None
    with pytest.raises(eigentol.InvalidValue, match="has no beam"):
        study.converge()
