"""The folder of a damage evaluation: one evaluation each, with its settings, complete or not there."""

import json
import math
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hh_exudyn import __version__
from hh_exudyn.cli.inputs import BadInput, require_new_folder
from hh_exudyn.cli.output import DOTS_PER_INCH

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from damage.report import DamageReport
    from hh_exudyn.log.store import Run

SETTINGS_FILE = "settings.json"


def chosen_folder(run: Path, out: Path | None, overwrite: bool) -> Path:
    """The folder that an evaluation goes into.

    Parameters
    ----------
    run
        Folder of the run.
    out
        The folder that is asked for; None: ``damage`` in the run's, or the first free of ``damage-2``, ...
    overwrite
        Whether an earlier evaluation there is replaced.

    Raises
    ------
    BadInput
        The folder is not empty, and is not an earlier evaluation that may be replaced.
    """
    folder = run / "damage" if out is None else out
    if overwrite and (folder / SETTINGS_FILE).is_file():
        return folder
    if overwrite and out is None and _taken(folder):
        raise BadInput(f"--overwrite: {folder} has no {SETTINGS_FILE}, so it is no evaluation to replace")
    if out is not None:
        require_new_folder(out)
    number = 1
    while out is None and _taken(folder):
        number += 1
        folder = run / f"damage-{number}"
    return folder


def _taken(folder: Path) -> bool:
    return folder.exists() and (not folder.is_dir() or any(folder.iterdir()))


@contextmanager
def complete_folder(folder: Path) -> Iterator[Path]:
    """A folder to write results into, put in the place of `folder` when the block ends without an error."""
    partial = folder.with_name(f"{folder.name}.part-{os.getpid()}")
    partial.mkdir(parents=True)
    try:
        yield partial
        if folder.is_dir():
            shutil.rmtree(folder)
        partial.replace(folder)
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def law_and_steel(report: "DamageReport", surface: str | None) -> str:
    """Law and steel of an evaluation in a few words, for figures and tables."""
    model = report.model
    state = f" ({surface})" if surface else ""
    return f"{model.law.name}{state}, {model.material.name}, {model.theory} on {model.normal}"


def save_labelled(figure: "Figure", text: str, path: Path) -> None:
    """Save a figure with a line in a strip of its own above it; the figure itself stays as it is.

    Parameters
    ----------
    figure
        To be saved.
    text
        The line.
    path
        Of the picture.
    """
    from matplotlib.transforms import Bbox

    strip = 0.22  # inches
    width, height = figure.get_size_inches()
    place = 1.0 + 0.5 * strip / height
    line = figure.text(0.99, place, text, ha="right", va="center", fontsize=7, color="0.35")
    line.set_in_layout(False)
    figure.savefig(path, dpi=DOTS_PER_INCH, bbox_inches=Bbox([[0.0, 0.0], [width, height + strip]]))


def settings(
    run: "Run", report: "DamageReport", surface: str | None, distance_km: float | None
) -> dict[str, Any]:
    """Everything that an evaluation depends on, in SI where its name has no unit.

    Parameters
    ----------
    run, report
        The run and its damage.
    surface
        State of the surfaces of the wear law as on the command line, None for its default.
    distance_km
        Distance of the damage; None for none.
    """
    model = report.model
    provenance = run.directory / "provenance.json"
    return {
        "law": {"name": model.law.name, "surface": surface, "numbers": _finite(model.law.numbers)},
        "steel": asdict(model.material),
        "rails": None
        if model.rails is None
        else {"steel": asdict(model.rails.material), "numbers": _finite(model.rails.wear.numbers)},
        "theory": model.theory,
        "normal_contact": model.normal,
        "cells": list(model.cells),
        "pressure_limit_Pa": _finite([model.pressure_limit])[0],
        "flange_angle_rad": model.flange_angle,
        "distance_km": distance_km,
        "skipped_bad_rows": report.bad_rows.count,
        "broken_parts_left_out": [
            str(broken.path.relative_to(run.directory)) for broken in run.broken_parts()
        ]
        if run.skip_broken_parts
        else [],
        "package": {"hh-exudyn": __version__},
        "run": {
            "finished": run.status["finished"],
            "reason": run.status["reason"],
            "inputs": json.loads(provenance.read_text(encoding="utf-8")).get("inputs")
            if provenance.is_file()
            else None,
        },
    }


def write_settings(folder: Path, values: dict[str, Any]) -> None:
    """Write the settings of an evaluation into its folder."""
    (folder / SETTINGS_FILE).write_text(json.dumps(values, indent=2) + "\n", encoding="utf-8")


def _finite(numbers: Any) -> list[float | str]:
    """Numbers for JSON, which has no infinity."""
    return [float(number) if math.isfinite(number) else str(number) for number in numbers]
