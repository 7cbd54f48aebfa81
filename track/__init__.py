"""The track: alignment, gauge, rails and the flexible substructure under each wheelset."""
