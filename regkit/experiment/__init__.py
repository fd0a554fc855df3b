"""Experiments: comparison of methods on the same data, template, start and tracker."""

from regkit.experiment.experiment import Experiment
from regkit.experiment.ledger import Outcome
from regkit.experiment.progress import Progress, Silent
from regkit.experiment.reporting import found, report
from regkit.experiment.runner import run
from regkit.experiment.sweeps.study import Study

__all__ = ["Experiment", "Outcome", "Progress", "Silent", "Study", "found", "report", "run"]
