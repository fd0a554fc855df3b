"""Who does the work of a run, as its options name it."""

from __future__ import annotations

from regkit.experiment.workers.cluster import DaskCluster
from regkit.experiment.workers.processes import Processes
from regkit.experiment.workers.team import ThisProcess, Workers
from regkit.system.errors import ConfigError


def chosen_workers(jobs: int, cluster: str | None) -> Workers:
    """This process, several others, or the workers of a cluster.

    Args:
        jobs: How many processes of this machine.
        cluster: ``SCHEME:ADDRESS`` of a cluster, or None.

    Raises:
        ConfigError: If both are asked for, or there is no such scheme.
    """
    if cluster is None:
        return ThisProcess() if jobs == 1 else Processes(jobs)
    place = f"--cluster {cluster}"
    if jobs != 1:
        raise ConfigError("a cluster has its own workers; leave --jobs out", place=place)
    scheme, _, address = cluster.partition(":")
    if scheme != "dask" or not address:
        raise ConfigError(
            "a cluster is named by a scheme and an address, and the only scheme is dask; such as "
            "dask:tcp://10.0.0.1:8786",
            place=place,
        )
    return DaskCluster(address)
