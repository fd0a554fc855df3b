"""Damaged inputs and YAML for every reader: ``python -m tests.fuzz --help``."""
