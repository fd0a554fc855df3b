"""Datasets: one file or package for each kind, and the ``formats`` that several of them share."""
