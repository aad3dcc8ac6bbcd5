"""JSON documents against the schema that the module states, by a validator of other people's making."""

import copy
import json

import pytest

import eigentol

jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is absent: no document is validated")

@pytest.fixture(scope="module")
def validator():
    schema = json.loads(eigentol.json_schema())
    kind = jsonschema.Draft202012Validator
    kind.check_schema(schema)
    return kind(schema)


@pytest.fixture(scope="module")
def documents(results):
    return [json.loads(own.to_json()) for own in results.values() if hasattr(own, "tables")]


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
