"""What can be swapped: the abstract plug-ins and the types that pass between them."""

from regkit.interfaces.dataset import Dataset, Sequence
from regkit.interfaces.kernel import Kernel, Response, Similarity
from regkit.interfaces.method import Method, Registered, Registrar
from regkit.interfaces.observer import Observer
from regkit.interfaces.shape import ShapeModel
from regkit.interfaces.solver import Problem, Solution, Solver
from regkit.interfaces.template import Template
from regkit.interfaces.tracker import Tracker

SLOTS = (Dataset, Template, Observer, ShapeModel, Kernel, Solver, Method, Tracker)
"""Every group of plug-ins, in the order in which data passes them."""

__all__ = [
    "SLOTS",
    "Dataset",
    "Kernel",
    "Method",
    "Observer",
    "Problem",
    "Registered",
    "Registrar",
    "Response",
    "Sequence",
    "ShapeModel",
    "Similarity",
    "Solution",
    "Solver",
    "Template",
    "Tracker",
]
