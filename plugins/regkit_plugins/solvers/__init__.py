"""Solvers, which minimise a registration problem.

- ``gauss_newton``: damped Gauss-Newton (Levenberg-Marquardt).
- ``lbfgs``: L-BFGS-B, from SciPy.
- ``ipopt``: IPOPT, from CasADi.
"""
