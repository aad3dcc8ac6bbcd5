"""Tables, text and HTML of results."""

import ast
import inspect
import pickle
import threading
from pathlib import Path

import numpy as np

import eigentol


def test_a_table_is_a_dictionary_of_columns(study):
    table = study.modes().table()
    assert list(table)[:2] == ["mode", "frequency [rad/s]"]
    assert table["frequency [rad/s]"][0] == study.modes().frequencies[0]
    summary = study.summary()
    assert set(map(len, summary.table(summary.tables[0]).values())) == {1}


def test_text_and_html(study):
    for result in [study.equilibrium(), study.modes(), study.first_order(), study.summary()]:
        assert "RotatingPendulum" in repr(result)
        html = result._repr_html_()
        assert html.count("<table>") == html.count("</table>") >= 1
    assert "&lt;" not in study.modes()._repr_html_()


def test_html_is_escaped(study):
    assert "<0>" not in study.worst_case([("frequency", 0)])._repr_html_()


def test_studies_and_mechanisms_can_be_sent_to_other_processes(study):
    again = pickle.loads(pickle.dumps(study.replace(design={"l": 1.2})))
    assert again.design[1] == 1.2
    np.testing.assert_array_equal(
        again.modes().eigenvalues, study.replace(design={"l": 1.2}).modes().eigenvalues
    )


def test_python_goes_on_while_samples_are_solved(study):
    study = study.replace(samples=300_000, vectors=False)
    done = threading.Event()
    found = []

    def sample():
        found.append(study.monte_carlo())
        done.set()

    thread = threading.Thread(target=sample)
    thread.start()
    steps = 0
    while not done.is_set():
        steps += 1
    thread.join()
    assert found[0].samples == 300_000
    # With the lock held throughout, at most a few steps happen before and after.
    assert steps > 1000


def public(kind):
    return {name for name in vars(kind) if not name.startswith("_")}


def test_the_stubs_say_what_there_is():
    stubs = Path(eigentol.__file__).with_name("__init__.pyi").read_text()
    described = {node.name: node for node in ast.parse(stubs).body if isinstance(node, ast.ClassDef)}
    described.pop("Settings")
    classes = {name: own for name, own in vars(eigentol).items() if inspect.isclass(own)}
    assert set(described) == set(classes)
    for name, own in classes.items():
        if issubclass(own, Exception):
            continue
        functions = {node.name for node in described[name].body if isinstance(node, ast.FunctionDef)}
        fields = {node.target.id for node in described[name].body if isinstance(node, ast.AnnAssign)}
        listed = {one for one in functions | fields if not one.startswith("_")}
        assert listed == public(own), name
        assert own.__doc__, name
        for member in public(own):
            assert getattr(own, member).__doc__, f"{name}.{member}"
