"""What can be swapped: the abstract plug-ins and the types that pass between them."""

from regkit.interfaces.dataset import Dataset, Sequence
from regkit.interfaces.kernel import Kernel, Response, Similarity
from regkit.interfaces.method import Method
from regkit.interfaces.observer import Observer
from regkit.interfaces.registrar import Fit, Registered, Registrar
from regkit.interfaces.shape import ShapeModel
from regkit.interfaces.solver import (
    Constraints,
    LimitKeeping,
    Multipliers,
    Problem,
    Solution,
    Solver,
)
from regkit.interfaces.template import Template
from regkit.interfaces.term import JointEnergy, Scene, Shares, Strain, Term
from regkit.interfaces.tracker import Follower, Tracker

SLOTS = (Dataset, Template, Observer, ShapeModel, Kernel, Term, Solver, Tracker, Method)
"""Every group of plug-ins, in the order in which data passes them."""

__all__ = [
    "SLOTS",
    "Constraints",
    "Dataset",
    "Fit",
    "Follower",
    "JointEnergy",
    "Kernel",
    "LimitKeeping",
    "Method",
    "Multipliers",
    "Observer",
    "Problem",
    "Registered",
    "Registrar",
    "Response",
    "Scene",
    "Sequence",
    "ShapeModel",
    "Shares",
    "Similarity",
    "Solution",
    "Solver",
    "Strain",
    "Template",
    "Term",
    "Tracker",
]
