"""The figure of one patch shows the numbers that it was given."""

import math
from io import BytesIO

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure

from hh_exudyn.contact.tangential.api import CreepForce, TractionField, creep_force, traction_field
from hh_exudyn.figures.patch import PatchLoad, patch_figure

LOAD = PatchLoad(a=6e-3, b=4e-3, normal_force=1e5, nu_x=1e-3, nu_y=0.0, phi=0.1, friction=0.3)
THEORIES = ("fastsim", "fastrip")


def results(
    load: PatchLoad, cells: tuple[int, int] = (20, 20)
) -> tuple[dict[str, CreepForce], dict[str, TractionField]]:
    forces = {name: creep_force(name, *load.arguments, cells=cells) for name in THEORIES}
    return forces, {name: traction_field(name, *load.arguments, cells=cells) for name in THEORIES}


def panels(figure: Figure, columns: int) -> list[list[Axes]]:
    """Maps of traction, strips and maps of slip, a list a row."""
    axes = figure.subfigs[0].axes
    return [axes[row * columns : (row + 1) * columns] for row in range(3)]


def drawn(figure: Figure) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, dpi=50)
    return buffer.getvalue()


def test_maps_show_traction_and_slip_of_every_theory() -> None:
    forces, fields = results(LOAD)
    figure = patch_figure(LOAD, forces, fields)
    assert drawn(figure).startswith(b"\x89PNG")
    traction, strip, slip = panels(figure, 2)
    assert [axes.get_title() for axes in traction] == list(THEORIES)
    for k, field in enumerate(fields.values()):
        (cells,) = (item for item in traction[k].collections if isinstance(item, QuadMesh))
        np.testing.assert_allclose(cells.get_array(), np.hypot(field.q_x, field.q_y) * 1e-6)
        # every cell's colour lies at its place
        corners = np.asarray(cells.get_coordinates())
        middles = 0.25 * (corners[1:, 1:] + corners[1:, :-1] + corners[:-1, 1:] + corners[:-1, :-1])
        np.testing.assert_allclose(middles[2:-2, :, 0], field.x[2:-2] * 1e3, atol=0.1)
        np.testing.assert_allclose(middles[:, :, 1], field.y * 1e3, atol=1e-12)
        curves = {line.get_label(): line for line in strip[k].lines}
        np.testing.assert_allclose(curves["$q_x$"].get_ydata(), field.q_x[10] * 1e-6)
        np.testing.assert_allclose(curves["$q_y$"].get_ydata(), field.q_y[10] * 1e-6)
        np.testing.assert_allclose(curves["$q_x$"].get_xdata(), field.x[10] * 1e3)
        (cells,) = (item for item in slip[k].collections if isinstance(item, QuadMesh))
        shown = np.ma.filled(cells.get_array(), 0.0)
        np.testing.assert_allclose(shown, np.hypot(field.slip_x, field.slip_y) * 1e3)
    # one scale for all theories
    maps = [item for axes in traction for item in axes.collections if isinstance(item, QuadMesh)]
    assert len({cells.norm.vmax for cells in maps}) == 1


def test_bars_are_forces_over_the_friction_limit() -> None:
    forces, _ = results(LOAD)
    forces["linear"] = CreepForce(-90e3, 1e3, -20.0)  # beyond the limit: its bar is cut, its number is not
    figure = patch_figure(LOAD, forces, {})
    drawn(figure)
    (axes,) = figure.subfigs[0].axes
    lengths = np.array([[bar.get_width() for bar in kind] for kind in axes.containers])
    limit = 0.3 * 1e5
    for k, force in enumerate(forces.values()):
        expected = (force.x / limit, force.y / limit, force.moment / (limit * math.sqrt(24e-6)))
        if k < 2:
            np.testing.assert_allclose(lengths[:, k], expected)
        for value in expected:
            assert f"{value + 0.0:.3f}" in [text.get_text() for text in axes.texts]
    assert lengths[0, 2] == -1.25
    assert [label.get_text() for label in axes.get_yticklabels()] == [*THEORIES, "linear"]
    assert axes.yaxis_inverted()  # the first theory is on top


@pytest.mark.parametrize(
    "load",
    [
        PatchLoad(6e-3, 4e-3, 1e5, 0.0, 0.0, 0.0, 0.3),  # nothing slides
        PatchLoad(6e-3, 4e-3, 1e5, 0.5, 0.0, 0.0, 0.3),  # everything does
        PatchLoad(1e-3, 9e-3, 1e5, 0.0, -1e-3, 2.0, 0.3),
        PatchLoad(9e-3, 1e-3, 1e5, 1e-4, 0.0, 0.0, 0.3),
    ],
)
def test_extreme_patches_are_drawn(load: PatchLoad) -> None:
    """Warnings are errors here: no border of stick and slip where there is none, no layout that collapses."""
    assert drawn(patch_figure(load, *results(load, (6, 5)))).startswith(b"\x89PNG")


def test_without_forces_there_is_no_figure() -> None:
    with pytest.raises(ValueError, match="at least one"):
        patch_figure(LOAD, {}, {})
