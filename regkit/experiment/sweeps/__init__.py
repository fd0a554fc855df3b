"""Sweeps: experiments with lists of values in YAML, expanded to one experiment per combination.

- ``study``: an experiment's YAML with its sweep.
- ``sweep``: expansion of the lists.
- ``labels``: names of the resulting experiments and methods.
"""
