"""Landmarks that no marker of a template can follow."""

from __future__ import annotations

from regkit.interfaces import Template
from regkit.observation import Landmarks
from regkit.system.notes import note


def tell_unknown(landmarks: Landmarks | None, template: Template, *, place: str) -> None:
    """Tells if no landmark has the name of a marker, so that all are ignored.

    Args:
        landmarks: The landmarks of a frame, if it has some.
        template: Template of the body.
        place: Name of the recording.
    """
    if landmarks is None:
        return
    markers = template.body(template.candidate_sizes()[0]).markers.names
    if not set(markers) & set(landmarks.names):
        note(
            f"no keypoint ({', '.join(landmarks.names)}) is a marker of the template "
            f"({', '.join(markers)}), so they are ignored; map their names "
            "(dataset.keypoint_markers)",
            place=place,
        )


def tell_unread(landmarks: Landmarks | None) -> None:
    """Tells that a method looks at no landmark, although a frame has some.

    Args:
        landmarks: The landmarks of a frame, if it has some.
    """
    if landmarks is not None:
        note(
            "the recording has keypoints, and the method looks at none of them; choose a method "
            "with a term that does, such as the default one"
        )
