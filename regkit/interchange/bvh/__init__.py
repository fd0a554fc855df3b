"""Motion and skeletons as BVH."""
