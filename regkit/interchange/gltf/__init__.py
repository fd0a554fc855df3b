"""The glTF format: import of rigged bodies and animations, export of tracked motion."""
