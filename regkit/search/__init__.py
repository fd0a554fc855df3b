"""Search: a limb's configurations held against a frame."""
