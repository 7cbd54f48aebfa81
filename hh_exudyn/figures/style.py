"""Common sizes and colours of the figures of this folder."""

SMALL = {"font.size": 8, "legend.fontsize": 7, "axes.titlesize": 8}  # for matplotlib's rc_context
WHEELSET_COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:purple", "tab:brown", "tab:cyan")


def wheelset_colour(number: int) -> str:
    """Colour of a wheelset by its number from 0; the seventh has that of the first."""
    return WHEELSET_COLOURS[number % len(WHEELSET_COLOURS)]
