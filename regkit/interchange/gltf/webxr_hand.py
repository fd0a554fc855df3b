"""The joint hierarchy of a WebXR hand, which its glTF models with their flat nodes lack.

Source: W3C, WebXR Hand Input Module, section 3.2 (skeleton joints).
"""

from __future__ import annotations

_PARTS = ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")


def _chain(finger: str, parts: tuple[str, ...]) -> dict[str, str]:
    names = [f"{finger}-{part}" for part in parts]
    return dict(zip(names, ["wrist", *names], strict=False))


PARENTS: dict[str, str | None] = {
    "wrist": None,
    **_chain("thumb", (_PARTS[0], _PARTS[1], *_PARTS[3:])),
    **{
        joint: parent
        for finger in ("index", "middle", "ring", "pinky")
        for joint, parent in _chain(f"{finger}-finger", _PARTS).items()
    },
}
"""The parent of each of the 25 joints; none for the wrist."""
