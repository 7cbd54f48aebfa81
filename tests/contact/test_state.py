"""A contact state out of a row of the contact log."""

import math
from dataclasses import asdict, fields

import numpy as np
import pytest

from hh_exudyn.contact.state import PATCH_COLUMNS, ContactState, contact_state, from_log_row
from hh_exudyn.conventions import RIGHT
from hh_exudyn.log.channels import CONTACT

STATE = contact_state(
    np.arange(1.0, PATCH_COLUMNS + 1.0), side=RIGHT, speed=20.0, Q=1e5, Y=-3e3, angle_of_attack=1e-3,
    roll=-2e-4, y_wheelset=4e-3, s=0.0,
)  # fmt: skip


def test_names_are_those_of_the_log() -> None:
    assert {field.name for field in fields(ContactState)} <= {column.name for column in CONTACT}


def test_a_row_gives_its_state() -> None:
    row = {"time": 0.1, "vehicle": 1, "wheelset": 2, "patch": 0} | asdict(STATE)
    assert from_log_row(row) == STATE
    assert from_log_row(row | {"side": np.int32(RIGHT), "Q": np.float64(1e5)}) == STATE


def test_rows_that_are_no_state() -> None:
    row = asdict(STATE)
    with pytest.raises(ValueError, match="column approach is missing"):  # a log of an older version
        from_log_row({key: value for key, value in row.items() if key != "approach"})
    for bad in (math.nan, None, "0.3"):
        with pytest.raises(ValueError, match=f"friction = {bad}"):
            from_log_row(row | {"friction": bad})
