"""Tables, text and HTML of results."""

import ast
import inspect
import pickle
import sys
import threading
import time
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
    assert "<0>" not in study.worst_case(["frequency 1"])._repr_html_()


def test_studies_and_mechanisms_can_be_sent_to_other_processes(study):
    again = pickle.loads(pickle.dumps(study.replace(design={"l": 1.2})))
    assert again.design[1] == 1.2
    np.testing.assert_array_equal(
        again.modes().eigenvalues, study.replace(design={"l": 1.2}).modes().eigenvalues
    )


def steps_during(work):
    """How often another thread runs while this one works; it does so only where this one gives up the interpreter's lock."""
    steps, stop = [0], threading.Event()

    def run():
        while not stop.is_set():
            steps[0] += 1
            time.sleep(0)

    usual = sys.getswitchinterval()
    # Nobody is made to give up the lock.
    sys.setswitchinterval(1000)
    other = threading.Thread(target=run)
    try:
        other.start()
        before = steps[0]
        work()
        return steps[0] - before
    finally:
        stop.set()
        sys.setswitchinterval(usual)
        other.join()


def test_python_goes_on_while_a_question_is_answered(study):
    assert steps_during(lambda: sum(range(1_000_000))) == 0
    study = study.replace(samples=60_000, vectors=False)
    assert steps_during(study.monte_carlo) > 100
    response = study.response("frequency 1")
    assert steps_during(lambda: response(np.tile(response.nominal, (20_000, 1)))) > 100


def public(kind):
    return {name for name in vars(kind) if not name.startswith("_")}


def test_the_stubs_say_what_there_is():
    stubs = Path(eigentol.__file__).with_name("__init__.pyi").read_text()
    described = {node.name: node for node in ast.parse(stubs).body if isinstance(node, ast.ClassDef)}
    # How settings and options are typed: of no use at run time.
    del described["Settings"], described["UrdfOptions"]
    # How the stubs name what all results have.
    shared = {"_Result": described.pop("_Result")}
    classes = {name: own for name, own in vars(eigentol).items() if inspect.isclass(own)}
    assert set(described) == set(classes)
    for name, own in classes.items():
        if issubclass(own, Exception):
            continue
        bases = [shared[base.id] for base in described[name].bases if getattr(base, "id", None) in shared]
        nodes = [node for one in [described[name], *bases] for node in one.body]
        functions = {node.name for node in nodes if isinstance(node, ast.FunctionDef)}
        fields = {node.target.id for node in nodes if isinstance(node, ast.AnnAssign)}
        listed = {one for one in functions | fields if not one.startswith("_")}
        assert listed == public(own), name
        assert own.__doc__, name
        for member in public(own):
            assert getattr(own, member).__doc__, f"{name}.{member}"
