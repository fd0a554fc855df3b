"""Segmenters, which take the body out of a scene.

- ``background``: removes what is static, learned from the recording or an empty one.
- ``gate``: removes what is far from the body's last pose.
- ``pieces``: keeps one connected piece.
- ``planes``: removes floor and walls.
- ``room``: what is needed of these, where the scene is larger than the body.
"""
