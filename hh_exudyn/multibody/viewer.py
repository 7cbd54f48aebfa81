"""Exudyn's own renderer on the system of a run: boxes for the bodies, wheels, rails, a camera that follows.

Shapes are given to the system's objects only where a viewer is wanted. They have no part in the motion: the
logs are those of the run without a viewer, bit for bit.
"""

import ctypes
import os
import sys
from typing import Any

import exudyn as exu
import numpy as np
from exudyn import graphics
from exudyn.itemInterface import ObjectGround, VObjectGround

from hh_exudyn.case import Case
from hh_exudyn.multibody.exudyn_system import ExudynSystem
from track.course.alignment import Alignment, inclined_frame
from track.course.frame import inclined_rotation
from vehicles.description import Body, Vehicle
from vehicles.outline import RUNNING_CIRCLE, WHEEL_WIDTH, body_box

_COLOURS = {
    "car_body": [0.65, 0.25, 0.2, 0.5],  # what it stands on is seen through it
    "wheelset": [0.45, 0.45, 0.5, 1.0],
    "bogie_frame": [0.2, 0.3, 0.45, 1.0],
    "side_frame": [0.2, 0.3, 0.45, 1.0],
    "bolster": [0.75, 0.55, 0.15, 1.0],
    "motor": [0.2, 0.5, 0.35, 1.0],
}
_RAIL = [0.3, 0.3, 0.3, 1.0]
_HALF_HEAD = 0.036  # m, of a rail
_STEP = 2.0  # m, between the points of a rail
_STARTUP = 30_000  # ms that a busy machine may take to open the window
_PERIOD = 0.04  # s between two pictures
_VIEW = [-1.413, -0.379, -0.428]  # rotation vector: from the right, 7 degrees from above, 30 from ahead
_HEIGHT = 0.75  # of the scene in the window, over the length of the vehicle


class NoScreen(RuntimeError):
    """Exudyn's renderer cannot open a window here."""


def require_screen() -> None:
    """Check that there is a screen to draw on.

    Raises
    ------
    NoScreen
        There is none. Exudyn itself would end the whole program.
    """
    if not sys.platform.startswith("linux"):
        return
    name = os.environ.get("DISPLAY")
    if not name or not _answers():
        raise NoScreen(
            "Exudyn's viewer needs a screen, and "
            + (f"DISPLAY {name} does not answer" if name else "DISPLAY is not set")
            + "; without one: hh-exudyn playback DIR --save F.rrd writes a recording to look at elsewhere"
        )


def _answers() -> bool:
    """Whether the X server of DISPLAY lets us in."""
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return False
    x11.XOpenDisplay.restype = ctypes.c_void_p
    screen = x11.XOpenDisplay(None)
    if not screen:
        return False
    x11.XCloseDisplay(ctypes.c_void_p(screen))
    return True


class Viewer:
    """One window of Exudyn's renderer for the whole run.

    Parameters
    ----------
    case : its track is drawn

    Raises
    ------
    NoScreen
        As `require_screen`.
    """

    def __init__(self, case: Case) -> None:
        require_screen()
        self._alignment = case.alignment()
        self._container: Any = None

    def dress(self, system: ExudynSystem) -> None:
        """Give a system its shapes, and the window its camera; before `Assemble()`.

        Parameters
        ----------
        system : as built
        """
        mbs, vehicle = system.mbs, system.vehicle
        for body in vehicle.bodies:
            mbs.SetObjectParameter(system.objects[body.name], "VgraphicsData", _shapes(vehicle, body))
        mbs.SetObjectParameter(system.forces, "Vshow", False)
        rails = [graphics.Lines(line, color=_RAIL) for line in _rails(self._alignment)]
        mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=rails)))
        settings = system.container.visualizationSettings
        settings.general.rendererStartupTimeout = _STARTUP
        settings.general.graphicsUpdateInterval = _PERIOD
        settings.general.showHelpOnStartup = 0
        settings.general.autoFitScene = False
        settings.nodes.show = settings.markers.show = settings.connectors.show = False
        camera = settings.view0.camera
        camera.trackMarker = system.markers[max(vehicle.bodies, key=lambda each: each.mass).name]

    def open(self, system: ExudynSystem) -> None:
        """Open the window on an assembled system.

        Parameters
        ----------
        system : of `dress`

        Raises
        ------
        NoScreen
            The window does not open.
        """
        if self._container is system.container:
            return
        renderer = system.container.renderer
        try:
            opened = renderer.Start()
        except exu.InternalError as error:
            raise NoScreen(f"Exudyn's viewer does not open: {' '.join(str(error).split())}") from None
        if not opened:
            raise NoScreen("Exudyn's viewer does not open: this Exudyn has no renderer")
        self._container = system.container
        places = np.array([body.position for body in system.vehicle.bodies])
        length = float(np.ptp(places[:, 0])) + 2.0 * RUNNING_CIRCLE
        renderer.SetModelView(zoom=_HEIGHT * length, rotationVector=_VIEW, centerPoint=[0.0, 0.0, 0.0])

    @property
    def closed(self) -> bool:
        """Whether its user has closed the window."""
        return self._container is not None and not self._container.renderer.IsActive()

    def picture(self) -> Any:
        """The window's picture, (height, width, 3) of 0..255."""
        return self._container.renderer.RedrawAndGetImage()

    def __enter__(self) -> "Viewer":
        return self

    def __exit__(self, *raised: object) -> None:
        """Close the window, if it is open."""
        if self._container is not None and self._container.renderer.IsActive():
            self._container.renderer.Stop()


def _shapes(vehicle: Vehicle, body: Body) -> list[dict[str, Any]]:
    """A box about the body's centre of mass, or the axle and wheels of a wheelset."""
    colour = _COLOURS[body.kind]
    for wheelset in vehicle.wheelsets:
        if wheelset.body == body.name:
            half = RUNNING_CIRCLE + WHEEL_WIDTH
            parts = [graphics.Cylinder([0.0, -half, 0.0], [0.0, 2 * half, 0.0], 0.09, colour, nTiles=16)]
            for side in (1, -1):
                start = side * RUNNING_CIRCLE - WHEEL_WIDTH / 2
                disc = [0.0, start, 0.0], [0.0, WHEEL_WIDTH, 0.0], wheelset.radius, colour
                parts.append(graphics.Cylinder(*disc, nTiles=32))
            return parts
    low, high = body_box(vehicle, body)
    middle = (low + high) / 2 - np.array(body.position)
    return [graphics.Brick(list(middle), list(high - low), color=colour)]


def _rails(alignment: Alignment) -> list[list[list[float]]]:
    """Points along the tops of both rails."""
    found: list[list[list[float]]] = [[], []]
    axes = np.zeros((3, 3))
    for s in np.arange(0.0, alignment.length + _STEP / 2, _STEP):
        x, y, z, heading, pitch, roll, _, gauge = inclined_frame(alignment.table, min(s, alignment.length))
        inclined_rotation(heading, pitch, roll, axes)
        for line, side in zip(found, (1, -1), strict=True):
            line.append(list(np.array([x, y, z]) + side * (gauge / 2 + _HALF_HEAD) * axes[:, 1]))
    return found
