"""What all results have in common: attributes for every number that they hold, pickling, one orientation of arrays."""

import inspect
import json
import math
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
    classes = {name for name in results if name in CLASSES}
    # A page is served by this process alone.
    assert classes | {"Answer", "Live"} == set(CLASSES)


def test_every_object_pickles(results):
    for own in results.values():
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


def test_only_a_document_is_read():
    for kind in (eigentol.Modes, eigentol.Answer):
        with pytest.raises(eigentol.InvalidValue):
            kind.from_json("{")


# Where a field of the Rust type is found that has another name; an attribute for a whole branch of fields, a text in
# round brackets for what is no result. Fields of the same name need no entry.
ELSEWHERE = {
    "Equilibrium": {
        "constraints.dependent": "dependent_constraints",
        "free.motions": "free",
        "free.held": "held",
        "free.balances": "(for the solvers)",
        "free.columns": "(for the solvers)",
        "free.rows": "(for the solvers)",
    },
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
        "whirls": "(`whirls` and `kinds` of the study)",
    },
    "Sensitivities": {
        "modes.lambda.by_design": "lambda_by_design",
        "modes.lambda.by_input": "lambda_by_input",
        "modes.general": "by_design",
        "modes.undamped": "family",
        "modes.value": "(the eigenvalue in Modes)",
    },
    "ForcedResponse": {
        "harmonics.frequency": "frequencies",
        "harmonics.shares.excitation": "excitations",
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
        "counts": "counts",
    },
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


@pytest.mark.parametrize("name", ELSEWHERE)
def test_every_field_of_the_rust_type_is_an_attribute(results, name):
    own = results[name]
    elsewhere, used = {"inputs": "operating_point", **ELSEWHERE[name]}, set()
    for path in set(fields(json.loads(own.to_json())["result"])):
        prefixes = [".".join(path[:k]) for k in range(1, len(path) + 1)]
        known = [prefix for prefix in prefixes if prefix in elsewhere]
        attribute = elsewhere[known[0]] if known else path[-1]
        used.update(known[:1])
        assert attribute.startswith("(") or hasattr(own, attribute), f"{name}: {'.'.join(path)}"
    assert set(elsewhere) - used <= {"inputs"}, f"{name} has no such fields"


def answers(results):
    return {kind: own for kind, own in results.items() if isinstance(own, eigentol.Answer)}


def numbers(value):
    """The numbers of a document in order, with NaN for what is missing."""
    if isinstance(value, dict):
        for name, own in value.items():
            yield from () if name == "description" else numbers(own)
    elif isinstance(value, list):
        for own in value:
            yield from numbers(own)
    elif value is None or value in ("Infinity", "-Infinity"):
        yield float(value.replace("Infinity", "inf")) if value else math.nan
    elif isinstance(value, (int, float)):
        yield float(value)


def read(value):
    """The same of what Python has."""
    if hasattr(value, "__dict__"):
        value = list(vars(value).values())
    if isinstance(value, np.ndarray):
        yield from value.ravel().astype(float)
    elif isinstance(value, list):
        for own in value:
            yield from read(own)
    elif value is None or isinstance(value, (int, float)):
        yield math.nan if value is None else float(value)


def test_every_number_of_a_document_is_an_attribute(results):
    for kind, own in answers(results).items():
        document = json.loads(own.to_json())["result"]
        document = {"entries": document} if isinstance(document, list) else document
        assert set(document) - {"description"} <= set(dir(own)), kind
        for name, value in document.items():
            if name in ("description", "inputs"):
                continue
            expected, found = np.array(list(numbers(value))), np.array(list(read(getattr(own, name))))
            # A missing row is one number in the document, and as many NaN as the other rows have in Python.
            np.testing.assert_array_equal(found[~np.isnan(found)], expected[~np.isnan(expected)], f"{kind} {name}")


def test_columns_are_those_of_the_tables(results):
    for own in answers(results).values():
        for name in own.tables[:1]:
            for heading, column in own.table(name).items():
                np.testing.assert_array_equal(own[heading], column)
                bare = heading.split(" [")[0]
                assert own.units[bare] == (heading.split(" [")[1][:-1] if " [" in heading else "")
        with pytest.raises(eigentol.UnknownName):
            own["no such column"]
        with pytest.raises(AttributeError, match="no_such_field"):
            own.no_such_field
    with pytest.raises(eigentol.UnknownName, match="did you mean `trusted`"):
        results["summary"]["trustd"]


def test_any_document_is_read(results):
    modes = eigentol.Answer.from_json(results["Modes"].to_json())
    assert modes.kind == "modes" and repr(modes).startswith("Swing: modes")
    np.testing.assert_array_equal(modes["frequency"], results["Modes"].frequencies)
    with pytest.raises(eigentol.InvalidValue, match="modes"):
        eigentol.Equilibrium.from_json(results["Modes"].to_json())


def test_samples_say_what_their_table_says(results):
    samples = results["MonteCarlo"]
    np.testing.assert_array_equal(samples.skewness(), samples.table()["skewness of frequency"])
    np.testing.assert_allclose(samples.quantile(0.5), np.median(samples.frequencies), rtol=1e-2)
    assert samples.least() <= samples.quantile(0.01) < samples.quantile(0.99) <= samples.greatest()
    with pytest.raises(eigentol.InvalidValue, match="between 0 and 1"):
        samples.quantile(1.5)
    (members,) = results["Clusters"].sigma()
    table = results["Clusters"].table("clusters")
    np.testing.assert_array_equal(members, np.array(table["sigma of member"])[: len(members)])


def test_an_event_says_what_it_is(results):
    event = results["event"]
    assert event.value == pytest.approx(event["speed"][0] * math.pi / 30) and event.units["speed"] == "rpm"
    assert event.spread.variance_shares.tolist() == [1.0]
    diagram = results["Campbell diagram"]
    assert all(kind in ("blade", "-", None) for kind in diagram["kind"]) and diagram.not_excited == []


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
    assert two.sensitivities().by_design.shape == (2, 3)


def test_a_variable_is_the_last_axis(two):
    step = 1e-4
    for mode in range(2):
        found = two.shape_sensitivity(mode)
        assert (found.right_by_design @ [1, 1j]).shape == (3, 2)
        for place, (name, value) in enumerate(two.mechanism.nominal.items()):
            ends = [
                two.replace(design={name: value + side}).modes().shapes[mode] for side in (step, -step)
            ]
            slope = (ends[0] - ends[1]) / (2 * step)
            np.testing.assert_allclose(found.right_by_design[place] @ [1, 1j], slope, atol=1e-7)
        table = found.table()
        expected = found.right_by_design[..., 0].T
        np.testing.assert_allclose(table["Re shape [per unit]"], expected.ravel(), rtol=1e-12)


def test_missing_numbers_are_nan(results, two):
    over = eigentol.Study(
        eigentol.Mechanism.from_text(TWO.replace("force second", "force pot: damper(on: y, damping: 500 N*s/m);\n    force second"))
    )
    modes = over.modes()
    missing = np.isnan(modes.frequencies)
    assert missing.any() and not missing.all()
    np.testing.assert_array_equal(np.isnan(over.whirls()), np.full(len(modes), True))
    np.testing.assert_array_equal(np.isnan(over.sensitivities().of("frequency")[1]).all(axis=1), missing)
    np.testing.assert_array_equal(np.isnan(over.second_order()["sigma of frequency"]), missing)
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
    found = results["convergence"]
    assert found["answer"] == [f"frequency {k}" for k in range(1, 6)]
    assert len(found.changes) == 5 and abs(found.changes[0].relative).max() < 1e-6
    assert found.without_peaks is None
    with pytest.raises(eigentol.InvalidValue, match="has no beam"):
        study.converge()
