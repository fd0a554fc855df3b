"""Kinematics, joint limits and the Gaussian correlation as CasADi functions.

They are for those who write an optimal control problem or a nonlinear program of their own, and for
solvers that hold limits as constraints. All take a *configuration*, which holds what a pose does:
``configuration`` tells its numbers.
"""

from regkit.casadi.configuration import configuration, pose_of, retract
from regkit.casadi.constraint_rows import ConstraintRows
from regkit.casadi.gaussians import correlation
from regkit.casadi.joint_limits import ball_limits, joint_limits
from regkit.casadi.kinematics import forward_kinematics, marker_positions

__all__ = [
    "ConstraintRows",
    "ball_limits",
    "configuration",
    "correlation",
    "forward_kinematics",
    "joint_limits",
    "marker_positions",
    "pose_of",
    "retract",
]
