"""Experiments: methods compared on the same data, template, start and tracker."""

from regkit.experiment.experiment import Experiment
from regkit.experiment.progress import Progress, Silent
from regkit.experiment.record import Outcome
from regkit.experiment.runner import run
from regkit.experiment.study import Study

__all__ = ["Experiment", "Outcome", "Progress", "Silent", "Study", "run"]
