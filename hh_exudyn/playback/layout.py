"""The blueprint: how the viewer arranges a recording."""

from collections.abc import Sequence

import rerun as rr
import rerun.blueprint as rrb

from hh_exudyn.playback.wheels import QUANTITIES
from vehicles.description import Vehicle
from vehicles.outline import vehicle_box

SKY = (196, 209, 222)
USUAL_LENGTH = 10.29  # length of the vehicle for EYE; the eye is farther from longer ones [m]
SHORTEST = 2.2  # length of a vehicle below which the eye is no nearer [m]
EYE = (6.95, 6.9, 1.95)  # from the point in the middle of the view [m]
LOOK_AT_HEIGHT = 1.55
CONTACT_EYE = (1.476, 1.2, 0.75)  # from the middle of the track below the leading axle [m]
CONTACT_LOOK_AT = (-0.074, 0.5, 0.25)
FRICTION_SCALE = 24.0  # the 2D view has one scale for both axes: utilised friction is drawn larger
LARGEST_FRICTION, LARGEST_PRESSURE = 0.6, 12.0
COUPLING_KINDS = {"force_kN": ("force", 1e-3), "displacement_mm": ("displacement", 1e3)}  # log's name, factor


def vehicle_view(vehicle: Vehicle, leader: str) -> rrb.Spatial3DView:
    """The whole vehicle from ahead and the left, in the frame that moves with the body `leader`."""
    low, high = vehicle_box(vehicle)
    length = max(high[0] - low[0], SHORTEST)
    scale = (length / USUAL_LENGTH) ** 0.75  # the far end of a long one is small anyhow
    ahead = 0.035 * length  # the near end takes more room in the picture
    middle = (low[0] + high[0]) / 2 - vehicle.body(leader).position[0] + ahead
    target = (middle, 0.0, min(LOOK_AT_HEIGHT, 0.5 * high[2]))
    eye = tuple(place + scale * away for place, away in zip(target, EYE, strict=True))
    return rrb.Spatial3DView(
        origin="/world/vehicle",
        contents=["+ /world/**"],
        name="Vehicle",
        background=SKY,
        line_grid=False,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital, position=eye, look_target=target, eye_up=(0.0, 0.0, 1.0)
        ),
    )


def blueprint(
    vehicle: Vehicle, leader: str, *, timeline: str = "sim_time", couplings: Sequence[str] = ()
) -> rrb.Blueprint:
    """Vehicle in 3D on the left; time series and shakedown diagram on the right.

    Parameters
    ----------
    vehicle
        The vehicle; its wheelsets are transparent in the view of the contacts.
    leader
        The body that the moving frame follows.
    timeline
        Initial timeline: ``sim_time`` or ``track_mm``.
    couplings
        Names of the couplings whose forces and displacements are in view; without, there are no such views.
    """
    wheelsets = [wheelset.body for wheelset in vehicle.wheelsets]
    hidden = [f"- /world/vehicle/{body.name}/**" for body in vehicle.bodies if body.name not in wheelsets]
    axle = max(vehicle.body(wheelset).position[0] for wheelset in wheelsets)
    axle -= vehicle.body(leader).position[0]
    views = rrb.Vertical(
        vehicle_view(vehicle, leader),
        rrb.Spatial3DView(
            origin="/world/vehicle",
            contents=["+ /world/**", *hidden],
            name="Wheels and contacts",
            background=SKY,
            line_grid=False,
            overrides={
                f"world/vehicle/{wheelset}": rr.Mesh3D.from_fields(albedo_factor=(255, 255, 255, 70))
                for wheelset in wheelsets
            },
            eye_controls=rrb.EyeControls3D(
                kind=rrb.Eye3DKind.Orbital,
                position=(axle + CONTACT_EYE[0], *CONTACT_EYE[1:]),
                look_target=(axle + CONTACT_LOOK_AT[0], *CONTACT_LOOK_AT[1:]),
                eye_up=(0.0, 0.0, 1.0),
            ),
        ),
        row_shares=[2.1, 1],
    )
    plots = [
        rrb.TimeSeriesView(
            origin=f"/plots/{key}",
            name=key.replace("_kN", " kN").replace("_over_", "/"),
            plot_legend=rrb.PlotLegend(visible=True),
        )
        for key in QUANTITIES
    ]
    if couplings:
        plots += [
            rrb.TimeSeriesView(
                origin=f"/couplings/{kind}",
                contents=[f"+ /couplings/{kind}/{name}/**" for name in couplings],
                name="coupling " + kind.replace("_", " "),
                plot_legend=rrb.PlotLegend(visible=True),
            )
            for kind in COUPLING_KINDS
        ]
    diagram = rrb.Spatial2DView(
        origin="/shakedown",
        name="Shakedown diagram",
        background=(24, 26, 30),
        visual_bounds=rrb.VisualBounds2D(
            x_range=(-1.0, LARGEST_FRICTION * FRICTION_SCALE + 0.5), y_range=(-LARGEST_PRESSURE - 0.4, 2.2)
        ),
    )
    right = rrb.Vertical(rrb.Tabs(*plots), diagram, row_shares=[1.15, 1])
    return rrb.Blueprint(
        rrb.Horizontal(views, right, column_shares=[2.2, 1]),
        rrb.TimePanel(state="collapsed", timeline=timeline),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )
