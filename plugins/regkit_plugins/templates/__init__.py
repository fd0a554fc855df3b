"""Templates and the YAML files that hold them."""
