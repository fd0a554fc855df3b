"""Kinematics, joint limits and the Gaussian correlation as CasADi functions.

Use them in your own optimal control problems or nonlinear programs, or in solvers that treat joint
limits as constraints. All functions take a *configuration*, a pose as one vector; see
``configuration`` for its layout. CasADi is imported when a function is called.
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
