"""Starts of alignments: candidates for T_target_source of two clouds in any orientation."""
