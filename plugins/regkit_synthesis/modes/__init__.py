"""Makes the shape modes of the templates from the bodies of anny, a statistical body model."""
