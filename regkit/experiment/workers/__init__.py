"""Execution of an experiment's tasks in this process, in local processes, or on a Dask cluster.

- ``team``: the interface of workers, and this process as the only one.
- ``processes``: worker processes, with joblib.
- ``cluster``: Dask workers.
- ``packed``: the serialised form of a task.
- ``schedule``: the order of the tasks.
- ``working``: distribution of tasks and collection of results.
"""
