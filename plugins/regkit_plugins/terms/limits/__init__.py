"""The limits term, which penalises violations of joint limits."""

from regkit_plugins.terms.limits.limits import LimitsTerm

__all__ = ["LimitsTerm"]
