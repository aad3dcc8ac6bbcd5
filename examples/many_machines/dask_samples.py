"""Samples on the processes of a Dask cluster, merged as they come: the same bits as one run.

    python dask_samples.py rotor.mechanism 1000000 --workers 2

With `--scheduler tcp://..` the tasks go to a cluster that is already there and has the module `eigentol`.
"""

import argparse
import time

import eigentol
from dask.distributed import Client, LocalCluster, as_completed


def samples(study, start, stop):
    """One task: some samples of the run."""
    return study.samples_between(start, stop)


def run(client, study, count, tasks):
    """All samples, in so many tasks, merged in the order in which they are done."""
    ends = [count * k // tasks for k in range(tasks + 1)]
    study = client.scatter(study, broadcast=True)
    futures = [client.submit(samples, study, *ends[k : k + 2], pure=False) for k in range(tasks)]
    done = as_completed(futures, with_results=True)
    _, total = next(done)
    for _, part in done:
        total.merge(part)
    return total


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mechanism")
    parser.add_argument("samples", type=int)
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="value of an input")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--tasks", type=int, default=16)
    parser.add_argument("--scheduler")
    options = parser.parse_args()

    study = eigentol.Study(
        eigentol.Mechanism.from_file(options.mechanism),
        inputs=dict(pair.split("=", 1) for pair in options.set),
        samples=options.samples,
        threads=1,
    )
    cluster = options.scheduler or LocalCluster(
        n_workers=options.workers, threads_per_worker=1, processes=True, dashboard_address=None
    )
    with Client(cluster) as client:
        began = time.perf_counter()
        total = run(client, study, options.samples, options.tasks)
        seconds = time.perf_counter() - began
    print(total.result())
    assert not total.missing
    print(f"{options.workers} workers: {seconds:.2f} s")


if __name__ == "__main__":
    main()
