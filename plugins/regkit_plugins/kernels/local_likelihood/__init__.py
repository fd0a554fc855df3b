"""The local-likelihood kernel: the likelihood of points under their nearest Gaussians."""

from regkit_plugins.kernels.local_likelihood.local_likelihood import LocalLikelihood

__all__ = ["LocalLikelihood"]
