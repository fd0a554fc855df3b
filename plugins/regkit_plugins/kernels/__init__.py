"""Similarity kernels."""
