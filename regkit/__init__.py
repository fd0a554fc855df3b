"""Articulated and rigid registration of shape models to point clouds and depth frames."""

__version__ = "0.1.0"
