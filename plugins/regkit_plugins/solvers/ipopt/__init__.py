"""The IPOPT solver, from CasADi."""

from regkit_plugins.solvers.ipopt.ipopt import Ipopt

__all__ = ["Ipopt"]
