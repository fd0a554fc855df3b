"""How well recordings were tracked, as the literature measures it, and how sure that is."""

from regkit.metrics.joints import JointErrors, joint_errors, matched
from regkit.metrics.losses import Losses
from regkit.metrics.measure import PCK_PART, TEN_CM, Measure, mean_of, measured
from regkit.metrics.pairs import Pair, compared
from regkit.metrics.statistics import Summary, summary
from regkit.metrics.thresholds import auc, share_within

__all__ = [
    "PCK_PART",
    "TEN_CM",
    "JointErrors",
    "Losses",
    "Measure",
    "Pair",
    "Summary",
    "auc",
    "compared",
    "joint_errors",
    "matched",
    "mean_of",
    "measured",
    "share_within",
    "summary",
]
