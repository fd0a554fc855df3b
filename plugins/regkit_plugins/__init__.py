"""The plug-ins that ship with regkit, registered by entry points like those of any distribution.

- ``datasets``: recordings in public and own formats.
- ``templates``: bodies to register.
- ``segmenters``: taking the body out of a scene.
- ``preprocessors``: from frames to observations.
- ``shapes``: shape models, from bodies to primitives.
- ``kernels``: similarities of primitives and observations.
- ``terms``: further energies and weights.
- ``solvers``: minimisation of a registration problem.
- ``methods``: registration of one frame.
- ``trackers``: prediction from frame to frame, and recovery.
- ``presets``: complete methods and datasets as YAML files.
"""
