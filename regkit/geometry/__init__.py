"""Geometry: rotations, rigid motions, cameras, capsules and skinned surfaces."""
