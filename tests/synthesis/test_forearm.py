"""The mesh of a hand is closed at the wrist, or continues into a forearm."""

from __future__ import annotations

import numpy as np
import pytest

from regkit_synthesis.assets import average_hand
from regkit_synthesis.bodies.forearm import with_forearm
from regkit_synthesis.bodies.hand import ShippedHand


@pytest.fixture(scope="module")
def hand():
    return average_hand()


def volume(mesh):
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    return np.einsum("ni,ni->", a, np.cross(b, c)) / 6.0


@pytest.mark.parametrize("length", [0.0, 0.1])
def test_wrist_is_closed_from_outside(hand, length):
    """Every edge belongs to two triangles, which pass it in opposite directions."""
    faces = with_forearm(hand, length, 0.3, 0.1).faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    assert len(np.unique(edges, axis=0)) == len(edges)
    assert {tuple(edge) for edge in edges} == {tuple(edge) for edge in edges[:, ::-1]}


def test_forearm_is_as_thick_as_the_wrist_or_thicker(hand):
    per_metre = (volume(with_forearm(hand, 0.1)) - volume(with_forearm(hand, 0.0))) / 0.1
    # An ellipse of the wrist's width and thickness.
    assert np.pi / 4.0 * 0.050 * 0.037 < per_metre < 2.0 * np.pi / 4.0 * 0.050 * 0.037


def test_hand_itself_stays(hand):
    longer = with_forearm(hand, 0.1, 0.5)
    np.testing.assert_array_equal(longer.vertices[: len(hand.vertices)], hand.vertices)
    np.testing.assert_array_equal(longer.faces[: len(hand.faces)], hand.faces)


def test_wrist_bends_towards_the_palm_and_the_little_finger(hand):
    wrist = hand.origin("wrist.R")
    knuckles = [hand.origin(f"finger{finger}-1.R") - wrist for finger in (2, 5)]
    across = knuckles[1] - knuckles[0]
    out_of_palm = np.cross(across, knuckles[0])
    straight, flexed, deviated = (
        with_forearm(hand, 0.1, *bend).vertices[-1] for bend in ((0, 0), (0.5, 0), (0, 0.3))
    )
    thumb = hand.origin("finger1-3.R") - wrist
    assert np.sign((flexed - straight) @ out_of_palm) == np.sign(thumb @ out_of_palm)
    assert (deviated - straight) @ across / np.linalg.norm(across) > 0.01


def test_shipped_hand_takes_a_forearm_in_degrees():
    straight, bent = (ShippedHand(forearm=0.1, flexion_deg=angle).body() for angle in (0, 90))
    assert np.linalg.norm(straight.mesh.vertices[-1] - bent.mesh.vertices[-1]) > 0.05
