"""After `pip install .` the tests are for the installed packages, which no folder of the checkout shadows."""

import importlib
import json
import os
import sys
import sysconfig
from importlib import resources
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]


def reason_to_test_the_checkout() -> str:
    """Why these are no tests of an installation, empty where they are; `.ci/run` accepts no reason."""
    if os.environ.get("HH_EXUDYN_TEST_INSTALLED") == "1":
        return ""
    if REPOSITORY in {Path(entry or ".").resolve() for entry in sys.path}:
        return "the checkout is in sys.path"
    try:
        origin = distribution("hh-exudyn").read_text("direct_url.json")
    except PackageNotFoundError:
        return "hh-exudyn is not installed"
    editable = json.loads(origin or "{}").get("dir_info", {}).get("editable", False)
    return "hh-exudyn is installed editable" if editable else ""


@pytest.mark.parametrize("name", ["hh_exudyn", "vehicles", "track", "damage"])
def test_package_comes_from_site_packages(name: str) -> None:
    if reason := reason_to_test_the_checkout():
        pytest.skip(reason)
    file = importlib.import_module(name).__file__
    assert file is not None
    assert Path(file).resolve().is_relative_to(Path(sysconfig.get_path("purelib")).resolve())


@pytest.mark.parametrize(
    "package, file",
    [
        ("hh_exudyn", "demo.toml"),
        ("hh_exudyn", "validation/creep_forces.csv"),
        ("hh_exudyn", "validation/stress_fields.npz"),
        ("hh_exudyn", "validation/en15302_conicity.csv"),
        ("vehicles", "iore_wagon.toml"),
        ("track", "flexibility.toml"),
        ("damage", "wear.toml"),
    ],
)
def test_data_files_are_in_the_packages(package: str, file: str) -> None:
    assert (resources.files(package) / "data" / file).is_file()
