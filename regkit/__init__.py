"""Articulated and rigid registration of shape models to point clouds and depth frames.

The names below are those of ``regkit.api``, which is imported when the first of them is used, so
that ``import regkit`` costs nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from regkit.api import (
        Camera,
        CloudAlignment,
        Keypoints,
        Landmarks,
        LivePose,
        LiveTrack,
        Preview,
        Registration,
        RegkitError,
        RegkitWarning,
        ShapedBody,
        Tracking,
        TrackingError,
        Truth,
        Tuned,
        Verdict,
        ViewsAlignment,
        align,
        align_all,
        examples_folder,
        fit_shape,
        frame_of_views,
        load_frame,
        load_keypoints,
        load_recording,
        load_template,
        open_source,
        preview,
        register,
        track,
        track_each,
        track_live,
        tune,
    )

__version__ = "0.2.0"

__all__ = [
    "Camera",
    "CloudAlignment",
    "Keypoints",
    "Landmarks",
    "LivePose",
    "LiveTrack",
    "Preview",
    "Registration",
    "RegkitError",
    "RegkitWarning",
    "ShapedBody",
    "Tracking",
    "TrackingError",
    "Truth",
    "Tuned",
    "Verdict",
    "ViewsAlignment",
    "__version__",
    "align",
    "align_all",
    "examples_folder",
    "fit_shape",
    "frame_of_views",
    "load_frame",
    "load_keypoints",
    "load_recording",
    "load_template",
    "open_source",
    "preview",
    "register",
    "track",
    "track_each",
    "track_live",
    "tune",
]


_RENAMED = {"load_sequence": "load_recording"}
"""Names that the API had before, and the names that it has now."""


def __getattr__(name: str) -> Any:
    """A name of the API, imported when it is first asked for."""
    if name in _RENAMED:
        raise AttributeError(f"'regkit.{name}' is now called 'regkit.{_RENAMED[name]}'")
    if name not in __all__:
        raise AttributeError(f"module 'regkit' has no attribute '{name}'")
    value = getattr(importlib.import_module("regkit.api"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """What a notebook completes."""
    return sorted({*globals(), *__all__})
