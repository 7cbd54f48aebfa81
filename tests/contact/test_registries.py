"""The registries of theories: what follows from a record, and what a new theory takes."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from hh_exudyn.case.contact import ContactCase
from hh_exudyn.contact.normal.registry import NORMAL, check_combination
from hh_exudyn.contact.tangential.registry import (
    PATCH_FIELD_THEORIES,
    PATCH_THEORIES,
    RUN_THEORIES,
    TANGENTIAL,
)
from hh_exudyn.contact.tangential.validation import contact_table

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("records", [TANGENTIAL, NORMAL])
def test_numbers_and_names_are_unique(records) -> None:
    assert len({record.number for record in records}) == len({record.name for record in records})
    assert len({record.number for record in records}) == len(records)
    assert all(record.meaning for record in records)


def test_a_case_takes_the_theories_of_the_registries() -> None:
    fields = ContactCase.model_fields
    assert get_args(fields["theory"].annotation) == RUN_THEORIES
    assert get_args(fields["normal"].annotation) == tuple(record.name for record in NORMAL)


def test_strips_go_with_theories_that_take_them() -> None:
    for normal in NORMAL:
        for theory in TANGENTIAL:
            known = not normal.only or theory.name in normal.only
            if normal.makes_strips and not (theory.takes_strips and known):
                with pytest.raises(ValueError, match="does not take the patches"):
                    check_combination(normal.name, theory.name)
            else:
                check_combination(normal.name, theory.name)


def test_the_table_of_errors_has_every_theory() -> None:
    rows = contact_table(cells=(6, 6))
    assert [*dict.fromkeys(row.theory for row in rows)] == list(PATCH_THEORIES)
    assert {row.theory for row in rows if row.fields} <= set(PATCH_FIELD_THEORIES)


DUMMY = """\"\"\"Full slip at any creepage.\"\"\"

import math

from hh_exudyn.kernel import kernel


@kernel
def force(patch):
    \"\"\"Creep force on the wheel.\"\"\"
    size = patch.friction * patch.normal_force / max(math.hypot(patch.nu_x, patch.nu_y), 1e-30)
    return -size * patch.nu_x, -size * patch.nu_y, 0.0
"""
EDITS = (  # in the registry: the text before which a line is put, the line
    ("CARTER = 3", "DUMMY = 11"),
    ("    Theory(STRIP,", '    Theory(DUMMY, "dummy", "full slip", has_field=False, has_moment=False),'),
    (
        "    if theory == FASTRIP:\n        return fastrip.force(",
        "    if theory == DUMMY:\n        return dummy.force(patch)",
    ),
    ("from hh_exudyn.contact.tangential.strips", "from hh_exudyn.contact.tangential import dummy"),
)  # fmt: skip
RUN = """
from importlib.resources import files
from hh_exudyn.case import Case
from hh_exudyn.contact.tangential import creep_force, traction_field
from hh_exudyn.contact.tangential.validation import contact_table

force = creep_force("dummy", 6e-3, 5e-3, 1e5, 3e-4, 4e-4, 0.0, 0.3)
print(round(force.x, 6), round(force.y, 6), force.moment)
try:
    traction_field("dummy", 6e-3, 5e-3, 1e5, 3e-4, 4e-4, 0.0, 0.3)
except ValueError as error:
    print(str(error)[:52])
demo = Case.from_toml((files("hh_exudyn") / "data/demo.toml").read_text(encoding="utf-8"))
print(demo.with_changes(contact={"theory": "dummy"}).contact.theory)
print([row.theory for row in contact_table(cells=(3, 3))].count("dummy"))
"""


@pytest.mark.slow
def test_a_new_theory_is_its_file_and_the_registry(tmp_path: Path) -> None:
    """In a copy of the toolkit, run without compiling: force, error message, case and table know it."""
    for package in ("hh_exudyn", "vehicles", "track"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    folder = tmp_path / "hh_exudyn" / "contact" / "tangential"
    (folder / "dummy.py").write_text(DUMMY, encoding="utf-8")
    text = (folder / "registry.py").read_text(encoding="utf-8")
    for before, line in EDITS:
        assert text.count(before) == 1, before
        text = text.replace(before, line + "\n" + before)
    (folder / "registry.py").write_text(text, encoding="utf-8")
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(tmp_path)}
    command = [sys.executable, "-c", RUN]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "-18000.0 -24000.0 0.0",
        "theory = 'dummy' gives forces only, no stress field;",
        "dummy",
        "1",
    ]
