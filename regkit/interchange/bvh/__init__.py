"""The BVH format: import of skeletons and motion, export of tracked motion."""
