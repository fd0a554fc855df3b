"""Parametric body models: SMPL and the models with its layout."""
