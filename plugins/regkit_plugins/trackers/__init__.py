"""Trackers, which predict the pose in the next frame and recover lost limbs.

- ``constant_pose``: starts each frame from the last pose.
- ``constant_velocity``: predicts by constant velocity, and recovers a lost body.
"""
