"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel."""
