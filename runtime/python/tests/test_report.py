"""Reports: one HTML file whose data are those of the results."""

import json
import math
import re

import pytest

import eigentol


def data(path, kind):
    """The pieces of data of one kind in a report."""
    start = f'<script type="application/json" data-kind="{kind}">'
    pieces = re.findall(re.escape(start) + "(.*?)</script>", path.read_text("utf-8"), re.DOTALL)
    return [json.loads(piece) for piece in pieces]


def column(path, table, name):
    own = next(own for own in data(path, "table") if own["name"] == table)
    return next(own["values"] for own in own["columns"] if own["name"] == name)


def test_a_report_has_the_numbers_of_the_study(study, tmp_path):
    path = tmp_path / "report.html"
    study.report(path, sweep=("omega", [4.0, 5.0, 6.0]), orders=[1.0], title="A bar <b>")
    text = path.read_text("utf-8")
    assert text.startswith("<!doctype html>")
    assert "<h1>A bar &lt;b&gt;</h1>" in text
    assert column(path, "modes", "frequency") == list(study.modes().frequencies)
    assert column(path, "Campbell diagram", "omega") == [4.0, 5.0, 6.0]
    titles = [figure["title"] for figure in data(path, "figure")]
    assert "Campbell diagram" in titles
    assert study.mechanism.text.splitlines()[0] in text


def test_values_of_the_sweep_may_have_a_unit(study, tmp_path):
    path = tmp_path / "report.html"
    study.report(path, sweep=("omega", [40, 60], "rpm"))
    assert column(path, "Campbell diagram", "omega") == pytest.approx([4.18879020, 6.28318531])


def test_modes_are_called_and_measured_as_the_user_says(study, tmp_path):
    path = tmp_path / "report.html"
    study.report(path, mode_names=["swing"], frequency_unit="Hz")
    hertz = study.modes().frequencies[0] / (2 * math.pi)
    assert f"Swing at {hertz:.4f}" in path.read_text("utf-8")
    assert data(path, "scene")[0]["motions"][0]["title"].startswith("Swing: ")
    with pytest.raises(ValueError, match="frequency_unit.*\"kHz\""):
        study.report(path, frequency_unit="kHz")


def test_mistakes_are_exceptions(study, tmp_path):
    with pytest.raises(OSError, match="cannot write"):
        study.report(tmp_path / "no" / "folder.html")
    with pytest.raises(eigentol.UnknownName):
        study.report(tmp_path / "report.html", sweep=("speed", [1.0]))
    with pytest.raises(TypeError, match="a sweep is a tuple"):
        study.report(tmp_path / "report.html", sweep=("omega",))
    assert not (tmp_path / "report.html").exists()
