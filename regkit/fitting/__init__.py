"""Templates from skinned meshes: what is fitted to the flesh that each segment carries."""
