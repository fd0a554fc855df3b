"""Shape models."""
