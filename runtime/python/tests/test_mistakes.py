"""Whatever is wrong raises an exception that says what, where, and what to do; no failure ends the interpreter."""

import numpy as np
import pytest

import eigentol


def test_mistakes_in_a_declaration_have_places():
    text = "mechanism Wrong {\n    body bar: rodd(mass: 1 kg, length: 1 m, along: z);\n}\n"
    with pytest.raises(eigentol.DeclarationError) as caught:
        eigentol.Mechanism.from_text(text)
    first = caught.value.mistakes[0]
    assert (first.line, first.column) == (2, 15)
    assert "rodd" in first.message and "`rod`" in first.help
    assert caught.value.path is None and isinstance(caught.value, ValueError)


def test_mistakes_in_a_file_name_it(tmp_path):
    path = tmp_path / "wrong.mechanism"
    path.write_text("mechanism Wrong { (")
    with pytest.raises(eigentol.DeclarationError, match=r"wrong\.mechanism:1:"):
        eigentol.Mechanism.from_file(path)


def test_a_missing_file(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        eigentol.Mechanism.from_file(tmp_path / "nowhere.mechanism")
    assert caught.value.filename == str(tmp_path / "nowhere.mechanism")


def test_a_file_that_is_no_text(tmp_path):
    path = tmp_path / "bytes.mechanism"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(OSError, match="bytes.mechanism"):
        eigentol.Mechanism.from_file(path)


@pytest.mark.parametrize(
    ("settings", "kind", "words"),
    [
        ({"inputs": {"omga": 1}}, eigentol.UnknownName, "did you mean `omega`"),
        ({"inputs": {"l": 1}}, eigentol.UnknownName, "that is a design variable"),
        ({"design": {"length": 1}}, eigentol.UnknownName, "no design variable `length`"),
        ({"start": {"tehta": 1}}, eigentol.UnknownName, "did you mean `theta`"),
        ({"tolerances": {"L": 1}}, eigentol.UnknownName, "did you mean `l`"),
        ({"inputs": {"omega": "3 mm"}}, eigentol.InvalidValue, "must be an angular speed"),
        ({"inputs": {"omega": "3 rpn"}}, eigentol.InvalidValue, "did you mean `rpm`"),
        ({"inputs": {"omega": "3"}}, eigentol.InvalidValue, "has no unit"),
        ({"inputs": {"omega": ")"}}, eigentol.InvalidValue, ""),
        ({"inputs": {"omega": float("nan")}}, eigentol.InvalidValue, "finite"),
        ({"design": {"l": np.inf}}, eigentol.InvalidValue, "finite"),
        ({"inputs": {"omega": [1.0]}}, TypeError, "a number"),
        ({"inputs": {"omega": None}}, TypeError, "a number"),
        ({"inputs": {3: 1.0}}, TypeError, "names are texts"),
        ({"inputs": 5.0}, TypeError, "dictionary"),
        ({"input": {"omega": 5.0}}, TypeError, "did you mean `inputs`"),
        ({"tolerances": {"l": "3 kg"}}, eigentol.InvalidValue, "length"),
        ({"tolerances": {"l": -0.1}}, eigentol.InvalidValue, "must be zero or positive"),
        ({"tolerances": {"l": (0.1, -0.1)}}, eigentol.InvalidValue, ""),
        ({"tolerances": {"l": float("nan")}}, eigentol.InvalidValue, "finite"),
        ({"tolerances": {"l": "300%"}}, eigentol.InvalidValue, "within the tolerance of `l`, length of bar would not be positive"),
        ({"tolerances": {"l": 3.0}}, eigentol.InvalidValue, "within the tolerance of `l`"),
        ({"tolerances": {"l": (-3.0, 0.1)}}, eigentol.InvalidValue, "within the tolerance of `l`"),
        ({"inputs": {"omega": "nan rad/s"}}, eigentol.InvalidValue, "unexpected `rad`"),
        ({"inputs": {"omega": ""}}, eigentol.InvalidValue, "found nothing"),
        ({"inputs": {"omega": 10**400}}, eigentol.InvalidValue, "too large"),
        ({"measured": {"l": [np.nan]}}, eigentol.InvalidValue, "finite"),
        ({"measured": {"l": []}}, eigentol.InvalidValue, "at least one"),
        ({"correlation": [[1.0]]}, eigentol.InvalidValue, "2 by 2"),
        ({"correlation": [[1.0, 2.0], [2.0, 1.0]]}, eigentol.InvalidValue, ""),
        ({"correlation": "none"}, TypeError, "square array"),
        ({"policy": "stabel"}, eigentol.InvalidValue, "did you mean `stable`"),
        ({"family": "damped"}, eigentol.InvalidValue, "undamped, general"),
        ({"samples": -1}, TypeError, "not negative"),
        ({"samples": 1.5}, TypeError, "whole"),
        ({"samples": True}, TypeError, "whole"),
        ({"samples": 0}, eigentol.InvalidValue, "at least one"),
        ({"sigma_level": 0.0}, eigentol.InvalidValue, ""),
        ({"seed": 2**64}, TypeError, "whole"),
    ],
)
def test_settings(pendulum, settings, kind, words):
    with pytest.raises(kind) as caught:
        eigentol.Study(pendulum, **settings)
    assert words in str(caught.value) and str(caught.value)


@pytest.mark.parametrize(
    ("question", "kind"),
    [
        (lambda study: study.replace(design={"l": -1.0}).modes(), eigentol.InvalidValue),
        (lambda study: study.mode_curvature(7), eigentol.InvalidValue),
        (lambda study: study.mode_curvature(-1), eigentol.InvalidValue),
        (lambda study: study.shape_sensitivity(2**62), eigentol.InvalidValue),
        (lambda study: study.response("frequency 2"), eigentol.InvalidValue),
        (lambda study: study.response("frequencies 1"), eigentol.InvalidValue),
        (lambda study: study.response(("frequency", 0)), TypeError),
        (lambda study: study.response("output angel"), eigentol.UnknownName),
        (lambda study: study.response("critical omega=1..nan"), eigentol.InvalidValue),
        (lambda study: study.response("frequency 1", variables=["k"]), eigentol.UnknownName),
        (lambda study: study.response("frequency 1")([1.0]), eigentol.InvalidValue),
        (lambda study: study.response("frequency 1")("l"), TypeError),
        (lambda study: study.propagate([()]), TypeError),
        (lambda study: study.propagate(["frequency 10"]), eigentol.InvalidValue),
        (lambda study: study.chances(["stabel"]), eigentol.InvalidValue),
        (lambda study: study.chances(["frequency 1 >= nan rad/s"]), eigentol.InvalidValue),
        (lambda study: study.reliability([((), 1.0, 2.0)]), TypeError),
        (lambda study: study.reliability(["angel within 1..2 rad"]), eigentol.UnknownName),
        (lambda study: study.sweep("omega", [1.0, np.nan]), eigentol.InvalidValue),
        (lambda study: study.sweep("omega", 5.0), TypeError),
        (lambda study: study.sweep("speed", [5.0]), eigentol.UnknownName),
        (lambda study: study.sweep("omega", [5.0], unit="mm"), eigentol.InvalidValue),
        (lambda study: study.campbell("omega", [5.0], [np.nan]), eigentol.InvalidValue),
        (lambda study: study.critical("omega", 6, 8), eigentol.NotInRange),
        (lambda study: study.probability([()]), TypeError),
        (lambda study: study.probability(["frequency 1 within 5..1 rad/s"]), eigentol.InvalidValue),
        (
            lambda study: study.probability(["frequency 1 away from speed by 10%"]),
            eigentol.UnknownName,
        ),
        (lambda study: study.modes().table("mode"), eigentol.UnknownName),
        (lambda study: study.monte_carlo().designs, eigentol.InvalidValue),
        (lambda study: study.sensitivities().of("speed"), eigentol.InvalidValue),
        (lambda study: study.mechanism.linear([0.1, 0.2]), eigentol.InvalidValue),
        (lambda study: study.mechanism.linear([np.nan]), eigentol.Error),
        (lambda study: study.mechanism.linear({"tehta": 1}), eigentol.UnknownName),
        (lambda study: study.motion()(0.0, [1.0]), eigentol.InvalidValue),
        (lambda study: study.motion()(0.0, [np.nan, 1.0]), eigentol.Error),
    ],
)
def test_questions(study, question, kind):
    with pytest.raises(kind) as caught:
        question(study)
    assert str(caught.value)


def test_an_input_without_a_value_is_named():
    text = """mechanism Stretched {
        input length: m;
        design m = 1 kg;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: m, length: length - m * (0.001 m/kg), along: -z);
        joint theta: revolute(y) from ground to bar;
    }"""
    mechanism = eigentol.Mechanism.from_text(text)
    words = "the input `length` was given no value and counts as 0"
    with pytest.raises(eigentol.InvalidValue, match=words):
        eigentol.Study(mechanism).modes()
    with pytest.raises(eigentol.InvalidValue) as caught:
        eigentol.Study(mechanism, inputs={"length": -1.0}).modes()
    assert "given no value" not in str(caught.value)
    # Nor is a tolerance to blame for it.
    tolerant = eigentol.Study(mechanism, tolerances={"m": "1%"})
    with pytest.raises(eigentol.InvalidValue, match=words):
        tolerant.modes()
    assert tolerant.replace(inputs={"length": 1.0}).modes().frequencies.shape == (1,)


@pytest.mark.parametrize("mode", [1, 7, 2**62])
def test_a_missing_mode_has_the_number_that_was_given(study, mode):
    with pytest.raises(eigentol.InvalidValue, match=f"no mode {mode}: modes are counted from 0"):
        study.mode_curvature(mode)


def test_no_equilibrium_says_where_it_ended():
    text = """mechanism Lift {
        body block: point(mass: 1 kg);
        gravity 9.81 m/s^2 along -z;
        joint z: prismatic(z) from ground to block;
        force hold: spring(on: z, stiffness: 1e-30 N/m);
    }"""
    try:
        study = eigentol.Study(eigentol.Mechanism.from_text(text))
        found = study.equilibrium()
    except eigentol.NoEquilibrium as error:
        assert len(error.coordinates) == 1
    else:
        assert np.isfinite(found.coordinates).all()
