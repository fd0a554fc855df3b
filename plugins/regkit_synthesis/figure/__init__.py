"""The human figure: the common joints of motion sources and bodies, and the maps to them.

Motion sources and bodies are independent of each other. A map of the source and a map of the body,
both YAML files (``maps/``), assign their joints and bones to the joints of the figure.
"""

from regkit_synthesis.figure.figure import AIMS, FIGURE, check_joints, figure_axes, leg_length
from regkit_synthesis.figure.joint_map import JointMap, parts_of
from regkit_synthesis.figure.map_files import MapName, read_map, shipped
from regkit_synthesis.figure.names import instead_of, meant
from regkit_synthesis.figure.standing import STANDING

__all__ = [
    "AIMS",
    "FIGURE",
    "STANDING",
    "JointMap",
    "MapName",
    "check_joints",
    "figure_axes",
    "instead_of",
    "leg_length",
    "meant",
    "parts_of",
    "read_map",
    "shipped",
]
