"""Figures on matplotlib, frames and datasets, units; each where the library is there."""

import pickle

import numpy as np
import pytest

import eigentol

BLOWER = """
mechanism Blower {
    input speed: rpm;
    design mass = 12 kg +/- 1 %;
    design shaft = 1.9 MN/m +/- 4 %;
    design oil = 310 N*s/m +/- 30 %;
    body bracket: massless;
    body hub: massless;
    body wheel: disk(mass: mass, radius: 200 mm, axis: z);
    joint across: prismatic(x) from ground to bracket;
    joint up: prismatic(y) from bracket to hub;
    joint spin: revolute(z) from hub to wheel, driven at speed;
    force sideways: spring(on: across, stiffness: shaft);
    force upwards: spring(on: up, stiffness: 1.2 * shaft);
    every displacement: damper(damping: oil);
    unbalance u: on wheel, eccentricity: 0.04 mm;
    output shake: um = across;
}
"""


@pytest.fixture
def study():
    return eigentol.Study(eigentol.Mechanism.from_text(BLOWER), inputs={"speed": "3000 rpm"}, samples=200)


def test_every_result_with_a_figure_is_drawn(study):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    along = ("speed", "0..6000 rpm")
    results = [study.campbell(*along, orders=[1]), study.sweep(*along), study.bode("speed", "2000..6000 rpm")]
    results += [study.modes(), study.first_order(), study.summary(), study.monte_carlo()]
    for result in results:
        axes = result.plot()
        for ax in np.atleast_1d(axes):
            assert ax.has_data(), result.kind if hasattr(result, "kind") else type(result)
        pyplot.close("all")
    _, ax = pyplot.subplots()
    assert results[0].plot(ax) is ax
    assert ax.get_xlabel() == "speed [rpm]" and ax.get_ylabel() == "frequency [Hz]"
    # The curve of the first mode is that of the result.
    table = results[0].table()
    own = table["frequency [rad/s]"][table["mode"] == 1] / (2 * np.pi)
    drawn = np.concatenate([line.get_ydata() for line in ax.get_lines() if line.get_color() == ax.get_lines()[0].get_color()])
    assert all(np.min(np.abs(drawn - value)) < 1e-9 * value for value in own)
    with pytest.raises(TypeError, match="no figure"):
        study.outputs().plot()


def test_tables_are_frames_and_datasets(study):
    pandas = pytest.importorskip("pandas")
    campbell = study.campbell("speed", "0..6000 rpm")
    frame = campbell.to_frame()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 51 * 2
    pytest.importorskip("xarray")
    data = campbell.to_xarray()
    assert dict(data.sizes) == {"speed": 51, "mode": 2} and data["frequency"].attrs["units"] == "rad/s"
    np.testing.assert_array_equal(data["frequency"].sel(mode=2).values, frame["frequency [rad/s]"][1::2])


def test_a_range_is_a_text_as_in_the_command(study):
    ends = study.campbell("speed", "0..6000 rpm").table()["speed [rpm]"]
    assert ends.min() == 0 and ends.max() == 6000 and len(np.unique(ends)) == 51
    with pytest.raises(ValueError, match="a list of values or a range"):
        study.campbell("speed", "6000 rpm")


def test_answers_are_stated_in_units_of_choice():
    mechanism = eigentol.Mechanism.from_text(BLOWER)
    assert mechanism.units["shake"] == "um"
    stated = pickle.loads(pickle.dumps(mechanism.in_units({"shake": "mm"}, frequency="rpm")))
    studies = [eigentol.Study(own, inputs={"speed": "3000 rpm"}) for own in (mechanism, stated)]
    [micrometres, millimetres] = [own.forced_response().table()["amplitude"][0] for own in studies]
    assert micrometres == pytest.approx(1000 * millimetres)
    assert "[rpm]" in str(studies[1].modes()) and "[Hz]" in str(studies[0].modes())
    with pytest.raises(eigentol.InvalidValue, match="must be a length"):
        mechanism.in_units({"shake": "kg"})
    with pytest.raises(eigentol.UnknownName):
        mechanism.in_units({"shok": "mm"})


def test_beams_are_drawn_as_deflection_curves_and_move_in_a_page():
    text = """mechanism Cantilever {
        body arm: beam(length: 1 m, along: x, up: z, bending: 6, stiffness_y: 1 N*m^2, stiffness_z: 4 N*m^2, mass_per_length: 1 kg/m);
        joint clamp: fixed from ground to arm;
    }"""
    study = eigentol.Study(eigentol.Mechanism.from_text(text))
    page = study.motion_page()
    assert page.html.startswith("<!doctype html>") and "srcdoc" in page._repr_html_()
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = study.plot_modes()
    assert [ax.get_ylabel() for ax in axes] == ["displacement along y", "displacement along z"]
    assert all(ax.get_xlabel() == "x [m]" for ax in axes)
