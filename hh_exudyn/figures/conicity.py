"""Figures of contact geometry, like Fig. 1-12 to 1-14 of the thesis (Hossein-Nia, KTH 2018).

Each function draws into given axes, in millimetres.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.functions import ContactFunctions, WheelsetFunctions
from hh_exudyn.contact.geometry.merit import ConicityReport
from hh_exudyn.contact.profile import Profile

_APART_MM = 15.0  # the wheel is drawn this far above its rail
_LABELS_APART_MM = 3.0


def draw_rail_profiles(axes: Axes, rails: Mapping[str, Profile]) -> None:
    """Rail heads over each other (Fig. 1-12), each in its own coordinates (top at z = 0)."""
    for label, rail in rails.items():
        axes.plot(1e3 * rail.y, 1e3 * rail.z, label=label)
    axes.set_xlabel("y towards the track centre [mm]")
    axes.set_ylabel("z [mm]")
    axes.set_aspect("equal")
    axes.set_ylim(-20.0, 2.0)
    axes.grid(alpha=0.3)
    axes.legend()


def draw_conicity(axes: Axes, reports: Mapping[str, ConicityReport]) -> None:
    """Equivalent conicity over the amplitude (Fig. 1-13)."""
    for label, report in reports.items():
        axes.plot(1e3 * report.amplitudes, report.conicity, marker="o", markersize=3, label=label)
    axes.set_xlabel("amplitude of the wheelset's lateral motion [mm]")
    axes.set_ylabel("equivalent conicity [-]")
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.grid(alpha=0.3)
    axes.legend()


def draw_radius_difference(axes: Axes, functions: Mapping[str, WheelsetFunctions]) -> None:
    """Rolling radius difference over the lateral displacement."""
    for label, one in functions.items():
        axes.plot(1e3 * one.lateral, 1e3 * one.radius_difference, label=label)
    axes.set_xlabel("displacement of the wheelset to the left [mm]")
    axes.set_ylabel("rolling radius difference, left less right [mm]")
    axes.grid(alpha=0.3)
    axes.legend()


def draw_contact_positions(
    axes: Axes, wheel: Profile, rail: Profile, functions: ContactFunctions, displacements: FloatArray
) -> None:
    """Wheel above rail, the points that touch each other joined by lines (Fig. 1-14).

    Parameters
    ----------
    axes : Axes
        Where to draw.
    wheel, rail : Profile
        Those of `functions`, drawn with the wheelset centred.
    functions : ContactFunctions
        Of the left or the right wheel.
    displacements : FloatArray
        Displacements of the wheelset outwards on this side, one line each, at the nearest of the table [m];
        some are written at the wheel, in millimetres.
    """
    outwards = functions.side * functions.lateral
    centred = int(np.nanargmin(np.abs(outwards)))
    offset = functions.y_rail[centred] - functions.y_wheel[centred]
    axes.plot(1e3 * (wheel.y + offset), 1e3 * wheel.z + _APART_MM, color="black")
    axes.plot(1e3 * rail.y, 1e3 * rail.z, color="black")
    labelled = -np.inf
    for displacement in np.sort(displacements):
        k = int(np.argmin(np.abs(outwards - displacement)))
        ends_y = np.array([functions.y_wheel[k] + offset, functions.y_rail[k]])
        ends_z = np.array(
            [
                np.interp(functions.y_wheel[k], wheel.y, wheel.z) + 1e-3 * _APART_MM,
                np.interp(functions.y_rail[k], rail.y, rail.z),
            ]
        )
        axes.plot(1e3 * ends_y, 1e3 * ends_z, color="tab:blue", linewidth=0.8)
        if 1e3 * ends_y[0] - labelled > _LABELS_APART_MM:  # where contacts lie close, only some are named
            labelled = 1e3 * ends_y[0]
            axes.annotate(
                f"{1e3 * displacement:g}",
                (labelled, 1e3 * ends_z[0]),
                textcoords="offset points",
                xytext=(0, 3),
                fontsize=7,
                ha="center",
            )
    axes.set_xlabel("y towards the track centre [mm]")
    axes.set_ylabel("z, the wheel lifted [mm]")
    axes.set_xlim(-40.0, 60.0)
    axes.set_ylim(-25.0, _APART_MM + 8.0)
    axes.set_aspect("equal")
    axes.grid(alpha=0.3)
