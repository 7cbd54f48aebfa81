"""The blueprint: how the viewer arranges a recording."""

import rerun as rr
import rerun.blueprint as rrb

from hh_exudyn.playback.wheels import QUANTITIES

SKY = (196, 209, 222)
EYE = (7.3, 6.9, 3.5)  # in the vehicle's moving frame [m]
LOOK_AT = (0.35, 0.0, 1.55)
CONTACT_EYE = (5.75, 1.2, 0.75)
CONTACT_LOOK_AT = (4.2, 0.5, 0.25)
FRICTION_SCALE = 24.0  # the 2D view has one scale for both axes: utilised friction is drawn larger
LARGEST_FRICTION, LARGEST_PRESSURE = 0.6, 12.0


def blueprint(bodies: list[str], wheelsets: list[str], *, timeline: str = "sim_time") -> rrb.Blueprint:
    """Wagon in 3D on the left; time series and shakedown diagram on the right.

    Parameters
    ----------
    bodies
        Names of all bodies below ``world/vehicle``.
    wheelsets
        Those that are wheelsets: they stay in the view of the contacts, see-through.
    timeline
        Shown at first: ``sim_time`` or ``track_mm``.
    """
    hidden = [f"- /world/vehicle/{body}/**" for body in bodies if body not in wheelsets]
    views = rrb.Vertical(
        rrb.Spatial3DView(
            origin="/world/vehicle",
            contents=["+ /world/**"],
            name="Wagon",
            background=SKY,
            line_grid=False,
            eye_controls=rrb.EyeControls3D(
                kind=rrb.Eye3DKind.Orbital, position=EYE, look_target=LOOK_AT, eye_up=(0.0, 0.0, 1.0)
            ),
        ),
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
                position=CONTACT_EYE,
                look_target=CONTACT_LOOK_AT,
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
