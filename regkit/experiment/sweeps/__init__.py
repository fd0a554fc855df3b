"""Sweeps: lists of values in the YAML, of which many experiments are made."""
