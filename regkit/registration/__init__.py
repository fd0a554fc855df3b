"""Registration: coordinates, constraints, robust losses and the problem with its chain rule."""
