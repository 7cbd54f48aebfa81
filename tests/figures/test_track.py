"""The figures of track show the numbers they were given."""

from io import BytesIO

import numpy as np
import pytest

from hh_exudyn.figures.track import line_sheet, track_sheet
from track.course.alignment import Alignment, Curve, Grade, Straight, Transition
from track.irregularity.irregularity import random_irregularity
from track.irregularity.quality import quality_limits, track_quality
from track.line.line import load_sections, read_line

TRACK = Alignment((Straight(100.0), Transition(50.0), Curve(350.0, 450.0, "right", 0.065, 1.445)))


def test_smooth_track_has_three_panels_with_the_signs_of_the_conventions() -> None:
    figure = track_sheet("smooth", TRACK)
    figure.savefig(BytesIO(), dpi=50)  # warnings are errors: the layout holds
    ends = [axes.lines[0].get_xydata()[[0, -1]] for axes in figure.axes]
    assert len(ends) == 3
    for (first, last), start, end in zip(ends, (0.0, 0.0, 1435.0), (-1e3 / 450, -65.0, 1445.0), strict=True):
        np.testing.assert_allclose([first, last], [(0.0, start), (500.0, end)], atol=1e-9)


def test_a_gradient_has_its_panel_in_per_mille_uphill_positive() -> None:
    alignment = Alignment((Straight(300.0),), grades=(Grade(100.0, 0.0), Grade(100.0, 0.0, -0.008)))
    figure = track_sheet("crest", alignment, random_irregularity("erri_low", 300.0, 1))
    figure.savefig(BytesIO(), dpi=50)
    assert len(figure.axes) == 8
    assert "\u2030" in figure.axes[3].get_ylabel()
    line = figure.axes[3].lines[0]
    for s, gradient in ((50.0, 0.0), (150.0, -4.0), (250.0, -8.0)):
        assert np.interp(s, line.get_xdata(), line.get_ydata()) == pytest.approx(gradient, abs=1e-6)
    assert "level" in figure.axes[4].get_ylabel()


def test_irregular_track_shows_four_signals_and_the_deviations() -> None:
    irregularity = random_irregularity("erri_high", 500.0, 1)
    quality = track_quality(irregularity, 60 / 3.6)
    limits = quality_limits(60 / 3.6)
    figure = track_sheet("rough", TRACK, irregularity, quality, limits)
    figure.savefig(BytesIO(), dpi=50)
    assert len(figure.axes) == 9
    for j, axes in enumerate(figure.axes[3:7]):
        np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e3 * irregularity.values[:, j])
    for j, axes in enumerate(figure.axes[7:]):
        bars = axes.patches[: len(quality.start)]
        np.testing.assert_allclose([bar.get_height() for bar in bars], 1e3 * quality.deviations[:, j])
        np.testing.assert_allclose([bar.get_x() for bar in bars], quality.start, atol=1e-9)
        np.testing.assert_allclose([line.get_ydata()[0] for line in axes.lines], 1e3 * limits[j])
    colours = [bar.get_facecolor() for bar in figure.axes[7].patches]
    assert (len(set(colours)) == 1) == (len(set(quality.classes.tolist())) == 1)


def test_every_panel_of_a_line_shows_the_whole_line() -> None:
    sections = load_sections(read_line("malmbanan"), "iore_wagon_loaded")
    figure = line_sheet("line", sections)
    figure.savefig(BytesIO(), dpi=50)
    for axes in figure.axes:
        assert sum(bar.get_height() for bar in axes.patches) == pytest.approx(100.0)
    by_class, by_cant, by_speed, by_quality = figure.axes
    labels = [label.get_text() for label in by_class.get_xticklabels()]
    assert (labels[0], labels[-1]) == ("<350", "straight")
    straight = sum(part.weight for part in sections if part.hand == "straight")
    at_end = [bar.get_height() for bar in by_class.patches if round(bar.get_x() + 0.4) == len(labels) - 1]
    assert sum(at_end) == pytest.approx(100.0 * straight)
    assert [label.get_text() for label in by_speed.get_xticklabels()] == ["60"]
    assert len(by_quality.get_xticklabels()) == 4
    assert by_cant.get_xticklabels()[0].get_text() == "0"


def test_without_sections_there_is_no_figure() -> None:
    with pytest.raises(ValueError, match="at least one"):
        line_sheet("line", ())
