"""Experiments: methods compared on the same data, template, start and tracker."""

from regkit.experiment.experiment import Experiment
from regkit.experiment.reporting import found, report
from regkit.experiment.runner import run

__all__ = ["Experiment", "found", "report", "run"]
