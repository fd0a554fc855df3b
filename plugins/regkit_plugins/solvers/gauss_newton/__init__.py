"""The Gauss-Newton solver, with Levenberg-Marquardt damping."""

from regkit_plugins.solvers.gauss_newton.gauss_newton import GaussNewton

__all__ = ["GaussNewton"]
