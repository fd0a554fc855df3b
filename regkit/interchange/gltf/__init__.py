"""Meshes, skeletons and motion as glTF."""
