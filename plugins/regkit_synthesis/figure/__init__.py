"""The human figure: the joints by which sources of motion and bodies meet, and the maps to them.

Neither a source nor a body knows the other: a map of the source and a map of the body, both YAML
files (``maps/``), say which joint of one human figure each of their joints and bones is.
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
