"""The likelihood kernel: a mixture of the placed Gaussians and outliers."""

from regkit_plugins.kernels.likelihood.likelihood import Likelihood, box_volume

__all__ = ["Likelihood", "box_volume"]
