"""JSON documents against the schema that the module states, by a validator of other people's making."""

import copy
import json

import pytest

import eigentol

jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is absent: no document is validated")

TEXT = """
pub mechanism Swing {
    input speed: rpm;
    design l = 1000 mm +/- 30 mm;
    gravity 9.81 m/s^2 along -z;
    body shaft: massless;
    body bar: rod(mass: 3 kg, length: l, along: -z);
    joint spin: revolute(z) from ground to shaft, driven at speed;
    joint theta: revolute(y) from shaft to bar;
    output angle = theta;
}
"""


@pytest.fixture(scope="module")
def validator():
    schema = json.loads(eigentol.json_schema())
    kind = jsonschema.Draft202012Validator
    kind.check_schema(schema)
    return kind(schema)


@pytest.fixture(scope="module")
def documents():
    mechanism = eigentol.Mechanism.from_text(TEXT)
    study = eigentol.Study(
        mechanism, inputs={"speed": "60 rpm"}, start={"theta": "1 rad"}, samples=64, keep_samples=True
    )
    speeds, frequency = [6.0, 6.1, 6.2], ("frequency", 0)
    wanted = [(frequency, 5.8, None), "stable"]
    results = [
        study.equilibrium(),
        study.assembly(),
        study.equilibrium_shift(),
        study.modes(),
        study.sensitivities(),
        study.outputs(),
        study.output_tolerances(),
        study.first_order(),
        study.second_order(),
        study.summary(),
        study.monte_carlo(),
        study.margin(0, low=5.0),
        study.propagate([frequency]),
        study.influence([frequency]),
        study.worst_case([frequency]),
        study.chances(wanted),
        study.probability(wanted),
        study.reliability(wanted[:1]),
        study.rare_failure(wanted[:1]),
        study.allocate(
            wanted[:1], failure=[0.1], tolerances={"l": ("1 mm", "100 mm", (0.0, 1.0, 1.0))}
        ),
        study.clusters(),
        study.sweep("speed", speeds),
        study.campbell("speed", speeds),
        study.branches("speed", 3.0, 6.0),
        study.critical("speed", 2.0, 6.0),
    ]
    return [json.loads(result.to_json()) for result in results]


def test_every_document_follows_the_schema(validator, documents):
    for document in documents:
        validator.validate(document)
    assert len({document["kind"] for document in documents}) == len(documents)


DAMAGES = {
    "another format": lambda own: own.update(format="other"),
    "another version": lambda own: own.update(version=2),
    "an unknown kind": lambda own: own.update(kind="shapes of clouds"),
    "no tables": lambda own: own.pop("tables"),
    "no result": lambda own: own.pop("result"),
    "a result that is a list": lambda own: own.update(result=[]),
    "an input without a unit": lambda own: own["inputs"]["speed"].pop("unit"),
    "a column without a unit": lambda own: own["tables"][0]["columns"][0].pop("unit"),
    "a word among numbers": lambda own: own["tables"][0]["columns"][1]["values"].append("fast"),
    "a column of an unknown kind": lambda own: own["tables"][0]["columns"][1].update(kind="dates"),
    "a coordinate without a name": lambda own: own["description"]["coordinates"][0].pop("name"),
    "lengths that are no digits": lambda own: own.update(lengths="many"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_documents_do_not(validator, documents, damage):
    document = copy.deepcopy(next(own for own in documents if own["kind"] == "modes"))
    DAMAGES[damage](document)
    assert not validator.is_valid(document)
