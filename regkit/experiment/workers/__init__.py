"""Who does an experiment's tasks: this process, others of this machine, or a Dask cluster."""
