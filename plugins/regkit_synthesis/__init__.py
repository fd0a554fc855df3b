"""Synthetic depth with exact truth: a skinned body, moved by recorded motion, seen by a camera.

The rooms, from the ground up:

- ``assets``: meshes, clips and hand poses that ship, with their licences.
- ``figure``: the human figure by whose joints motions and bodies meet, and the maps to it.
- ``motion``: where the motion of a figure comes from, and how it is played.
- ``hands``: recorded poses of a hand, and gestures that run through them.
- ``bodies``: rigged bodies and hands, and how they follow a motion.
- ``viewpoint``: where the camera of a motion is.
- ``rooms``: what stands around a body.
- ``recordings``: takes, scenes, and the depth recordings that are rendered of them.
- ``templates``: the makers of the templates that ship.
- ``samples``: the makers of the sample recordings that ship.
"""
