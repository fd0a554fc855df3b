"""Workers of a run, as chosen by its options."""

from __future__ import annotations

from regkit.experiment.workers.cluster import DaskCluster
from regkit.experiment.workers.processes import Processes
from regkit.experiment.workers.team import ThisProcess, Workers
from regkit.system.errors import ConfigError


def chosen_workers(jobs: int, cluster: str | None) -> Workers:
    """Returns this process, worker processes, or the workers of a cluster.

    Args:
        jobs: Number of processes on this machine.
        cluster: ``SCHEME:ADDRESS`` of a cluster, or None.

    Raises:
        ConfigError: If both are requested, or the scheme is unknown.
    """
    if cluster is None:
        return ThisProcess() if jobs == 1 else Processes(jobs)
    place = f"--cluster {cluster}"
    if jobs != 1:
        raise ConfigError("a cluster has its own workers; leave out --jobs", place=place)
    scheme, _, address = cluster.partition(":")
    if scheme != "dask" or not address:
        raise ConfigError(
            "a cluster is given as SCHEME:ADDRESS, and the only scheme is dask, as in "
            "dask:tcp://10.0.0.1:8786",
            place=place,
        )
    return DaskCluster(address)
