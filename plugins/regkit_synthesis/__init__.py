"""Synthetic depth with exact truth: a skinned body, moved by recorded motion, seen by a camera."""
