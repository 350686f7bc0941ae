"""Friction from many logs at once, on all cores: one estimate a log, in the order of the logs.

    many_logs.py LOG.csv [LOG.csv]...

On a cluster the same lines take dask.distributed: `with Client("scheduler:8786") as pool:` in place of the pool below, and
`pool.gather(pool.map(identify, paths))` in place of `list(pool.map(identify, paths))`. Logs, estimates and what is raised can be
pickled, so that joblib and multiprocessing do as well.
"""

import concurrent.futures
import sys

import warmjoint as wj


def identify(path):
    return wj.identify(path)  # arguments of wj.read may follow, as unit={"position": "deg"}


def main():
    paths = sys.argv[1:]
    if not paths:
        sys.exit(__doc__)
    with concurrent.futures.ProcessPoolExecutor() as pool:
        estimates = list(pool.map(identify, paths))
    for path, estimate in zip(paths, estimates):
        print(path, estimate.status, *(f"{one.name}={one.value:.4g}" for one in estimate.parameters.values()))


# a child process reads this file again
if __name__ == "__main__":
    main()
