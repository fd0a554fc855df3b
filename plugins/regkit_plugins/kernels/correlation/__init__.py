"""The correlation kernel: the overlap of model and data Gaussians, the paper's similarity."""

from regkit_plugins.kernels.correlation.correlation import Correlation

__all__ = ["Correlation"]
