"""``hh-exudyn twist-test``: refusals, and its verdicts."""

from functools import partial
from importlib.resources import files
from pathlib import Path
from types import SimpleNamespace

import command_line
import numpy as np
import pytest

from hh_exudyn.assessment.twist_test import Twist, TwistResult, twist_limits
from hh_exudyn.cli import twist_test

call = partial(command_line.call, "twist-test")
DEMO = str(files("hh_exudyn").joinpath("data/demo.toml"))


def test_refusals(tmp_path: Path) -> None:
    """A vehicle with one wheelset has no twist; a folder with something in it is not written to."""
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "a.txt").write_text("")
    for words, reason in (
        ((DEMO, "--out", tmp_path / "full"), "is not empty"),
        ((tmp_path / "none.toml", "--out", tmp_path / "new"), "none.toml"),
        (
            (DEMO, "--vehicle", "suspended_wheelset", "--out", tmp_path / "new"),
            "suspended_wheelset has one bogie or wheelset: a twist test needs two",
        ),
    ):
        result = call(*words)
        assert result.exit_code == 2, result.stdout
        assert reason in result.stderr
        assert result.stderr.count("\n") == 1
        assert not (tmp_path / "new").exists()


def test_verdicts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each with value, limit and source; the curve is left-hand, so that right wheels are judged."""
    wheels = ("wheel 1L", "wheel 1R")
    results = {
        "straight": TwistResult(wheels, np.array([0.65, 0.1]), np.array([0.02, 0.01])),
        "curve": TwistResult(wheels, np.array([0.2, 0.3]), np.array([1.3, 0.7])),
    }

    watched = SimpleNamespace(status={"watch": [{"wheel": "1L", "lift_mm": 0.4}]})
    lines: list[str] = []
    monkeypatch.setattr(twist_test.output, "print_line", lines.append)
    twist_test._show(Twist(1.8, 9.0, 4.2e-3, 3.7e-3), results, {"curve": watched}, twist_limits())  # type: ignore[dict-item]
    text = "\n".join(lines)
    assert "twist of a bogie 4.20 per mille over 1.800 m, of the body 3.70 per mille over 9.000 m" in text
    assert "dQ/Q0 on straight track: 0.65, limit 0.6 ?: EXCEEDED (published: EN 14363" in text
    assert "Y/Q of an outer wheel in the curve: 0.7, limit 1.2 ?: holds" in text
    assert "lift of a wheel in the curve [mm]: 0.4, limit 5 ?: holds" in text
