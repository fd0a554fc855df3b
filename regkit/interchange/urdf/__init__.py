"""Robots as URDF."""
