"""Skeletons, bodies and motion in the formats of other programs: a file for each format."""
