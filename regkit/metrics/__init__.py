"""Tracking metrics of the literature, and statistics over recordings."""

from regkit.metrics.checked import checked_measure
from regkit.metrics.joints import JointErrors, joint_errors
from regkit.metrics.losses import Losses
from regkit.metrics.matching import check_reference_unit, matched, tell_unmatched
from regkit.metrics.measure import (
    METRICS,
    PCK_FRACTION,
    TEN_CM,
    Measure,
    in_words,
    mean_of,
    measured,
)
from regkit.metrics.pairs import Pair, compared
from regkit.metrics.parts import exchanged_frames, parts_of_markers
from regkit.metrics.statistics import Summary, summary
from regkit.metrics.thresholds import auc, fraction_within

__all__ = [
    "METRICS",
    "PCK_FRACTION",
    "TEN_CM",
    "JointErrors",
    "Losses",
    "Measure",
    "Pair",
    "Summary",
    "auc",
    "check_reference_unit",
    "checked_measure",
    "compared",
    "exchanged_frames",
    "fraction_within",
    "in_words",
    "joint_errors",
    "matched",
    "mean_of",
    "measured",
    "parts_of_markers",
    "summary",
    "tell_unmatched",
]
