"""What several sources share; not plug-ins.

- ``realsense_topics``: which bags are recordings of RealSense cameras.
- ``clock``: times that do not go back.
- ``lenses``: coefficients of distortion as drivers give them.
"""
