"""Trackers, which predict the pose of the next frame and recover a lost body.

- ``constant_pose``: starts each frame from the last pose.
- ``constant_velocity``: predicts by constant velocity, and recovers a lost body.
"""
