"""The track: alignment, irregularities, gauge, rails, friction, and the flexible substructure."""
