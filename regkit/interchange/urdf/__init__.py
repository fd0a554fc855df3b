"""The URDF format: import of robots as templates."""
