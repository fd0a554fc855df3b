"""Makes the templates: proportions, surfaces and Gaussians fitted to skinned meshes."""
