"""Figures of wheel forces: every wheel in its panel, ranges and densities as they are."""

import numpy as np
import pytest

from hh_exudyn.figures.wheel_forces import force_histograms, force_spectra


def test_histograms_show_each_wheel_and_its_range() -> None:
    rng = np.random.default_rng(1)
    means = 1e3 * np.array([[100.0, 110.0], [120.0, 130.0]])
    forces = {
        "loaded": means + 1e3 * rng.normal(size=(4000, 2, 2)),
        "empty": 0.3 * means + 1e3 * rng.normal(size=(4000, 2, 2)),
    }
    figure = force_histograms("a title", "Q", forces, measured=1.02 * forces["loaded"][::10])
    assert [axes.get_title() for axes in figure.axes] == [
        "wheelset 1, left", "wheelset 1, right", "wheelset 2, left", "wheelset 2, right",
    ]  # fmt: skip
    for axes, (number, side) in zip(figure.axes, np.ndindex(2, 2), strict=True):
        drawn = sorted(float(line.get_xdata()[0]) for line in axes.lines)
        expected = sorted(
            1e-3 * bound(values[:, number, side]) for values in forces.values() for bound in (np.min, np.max)
        )
        assert drawn == pytest.approx(expected)
        assert len(axes.containers) == 3
        for container in axes.containers:
            area = sum(bar.get_width() * bar.get_height() for bar in container)
            assert area == pytest.approx(1.0)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "measured", "loaded", "empty",
    ]  # fmt: skip
    assert figure.axes[-1].get_xlabel() == "Q [kN]"


def test_spectra_show_densities_and_marks() -> None:
    frequency = np.arange(0.0, 100.0, 0.25)
    density = np.ones((400, 4, 2)) * 1e6 * np.arange(1, 9).reshape(4, 2)
    figure = force_spectra("a title", "Q", {"low": (frequency, density)}, {"sleepers": 27.8})
    assert len(figure.axes) == 8
    for value, axes in enumerate(figure.axes, 1):
        curve, mark = axes.lines
        assert curve.get_ydata() == pytest.approx(float(value))  # kN^2/Hz
        assert curve.get_xdata()[[0, -1]] == pytest.approx([0.25, 60.0])
        assert mark.get_xdata() == pytest.approx([27.8, 27.8])


def test_bad_shapes_are_refused() -> None:
    with pytest.raises(ValueError, match=r"arrays \(n, wheelsets, 2\)"):
        force_histograms("", "Q", {})
    with pytest.raises(ValueError, match=r"arrays \(n, wheelsets, 2\)"):
        force_histograms("", "Q", {"a": np.ones((5, 4, 2))}, measured=np.ones((5, 2, 2)))
    with pytest.raises(ValueError, match=r"arrays \(m, wheelsets, 2\)"):
        force_spectra("", "Q", {})
