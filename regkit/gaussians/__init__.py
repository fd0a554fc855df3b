"""Gaussians against points: pairs, moments, and the side that a camera sees."""
