"""What datasets share: the formats of files."""
