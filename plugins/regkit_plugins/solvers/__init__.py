"""Solvers, which minimise a registration problem.

Modules:
    gauss_newton: Damped Gauss-Newton (Levenberg-Marquardt).
    lbfgs: L-BFGS-B, from SciPy.
    ipopt: IPOPT, from CasADi.
"""
