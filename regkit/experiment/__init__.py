"""Experiments: methods compared on the same data, template, start and tracker."""

from regkit.experiment.experiment import Experiment
from regkit.experiment.results import Results
from regkit.experiment.runner import run

__all__ = ["Experiment", "Results", "run"]
