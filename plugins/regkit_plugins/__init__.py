"""The plug-ins that ship with regkit; they come in by the same door as anyone's."""
