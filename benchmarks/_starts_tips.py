"""Fingertips in the images of a real hand, marked by eye.

They are those of SR305's sequence 20210326-231615, a right hand that shows its palm, to about a
centimetre where a finger is bent to the camera.
"""

from __future__ import annotations

from collections.abc import Mapping

FINGERS = ("thumb", "index", "middle", "ring", "little")

TIPS: Mapping[int, tuple[tuple[int, int], ...]] = {
    0: ((300, 298), (294, 225), (258, 217), (240, 226), (224, 256)),
    20: ((377, 285), (355, 250), (329, 232), (305, 229), (288, 255)),
    40: ((353, 297), (339, 256), (307, 238), (284, 233), (264, 257)),
    60: ((362, 291), (349, 246), (304, 211), (288, 220), (276, 245)),
    80: ((358, 283), (350, 213), (316, 252), (294, 236), (272, 243)),
    100: ((353, 283), (352, 211), (321, 249), (298, 237), (283, 262)),
    140: ((324, 295), (340, 213), (302, 206), (287, 221), (273, 257)),
    160: ((393, 272), (341, 213), (299, 210), (293, 246), (293, 287)),
    180: ((398, 268), (358, 229), (332, 212), (310, 207), (284, 234)),
    200: ((395, 252), (346, 200), (311, 196), (299, 214), (302, 265)),
    220: ((383, 279), (378, 213), (342, 204), (332, 228), (330, 281)),
}
"""Column and row of each fingertip, from the thumb to the little finger, by image."""
