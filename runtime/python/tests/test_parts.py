"""Samples in parts: one run in any split, on processes of Dask where it is."""

import importlib.util
import pathlib
import pickle

import pytest

import eigentol

EXAMPLE = pathlib.Path(__file__).parents[3] / "examples" / "many_machines" / "dask_samples.py"


@pytest.fixture
def sampled(pendulum):
    return eigentol.Study(pendulum, inputs={"omega": 5.0}, start={"theta": 1.0}, samples=2000, seed=7)


def test_parts_merge_to_the_whole(sampled):
    total = sampled.samples_between(1500, 2000)
    for ends in [(0, 700), (700, 1500)]:
        total.merge(pickle.loads(pickle.dumps(sampled.samples_between(*ends))))
    assert total.ranges == [(0, 2000)] and total.missing == []
    assert str(total.result()) == str(sampled.monte_carlo())
    assert (total.result().sigma() == sampled.monte_carlo().sigma()).all()


def test_parts_of_other_runs_and_samples_that_are_there_are_refused(sampled, pendulum):
    total = sampled.samples_between(0, 100)
    assert total.missing == [(100, 2000)]
    with pytest.raises(eigentol.Error, match="already"):
        total.merge(sampled.samples_between(50, 150))
    other = eigentol.Study(pendulum, inputs={"omega": 5.0}, start={"theta": 1.0}, samples=2000, seed=8)
    with pytest.raises(eigentol.Error, match="seed"):
        total.merge(other.samples_between(100, 200))
    with pytest.raises(eigentol.Error, match="already"):
        total.merge(total)
    with pytest.raises(TypeError, match="`start`"):
        sampled.samples_between(-1, 5)
    assert total.ranges == [(0, 100)]


def test_texts_that_are_cut_off_are_refused(sampled):
    text = sampled.samples_between(0, 100).to_json()
    with pytest.raises(eigentol.InvalidValue, match="cut off"):
        eigentol.PartialMonteCarlo.from_json(text[: len(text) // 2])
    with pytest.raises(eigentol.InvalidValue, match="not a partial result"):
        eigentol.PartialMonteCarlo.from_json('{"a": 1}')


def test_dask_gives_the_bits_of_one_run(sampled):
    distributed = pytest.importorskip("dask.distributed", reason="Dask is absent: no samples on its processes")
    spec = importlib.util.spec_from_file_location("dask_samples", EXAMPLE)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        total = example.run(client, sampled, 2000, 5)
    assert total.missing == []
    assert str(total.result()) == str(sampled.monte_carlo())
