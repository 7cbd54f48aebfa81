"""Under `.ci/run` the tests are for the installed packages: the checkout's folders must not shadow them."""

import importlib
import os
import sysconfig
from importlib import resources
from pathlib import Path

import pytest


@pytest.mark.skipif(
    os.environ.get("HH_EXUDYN_TEST_INSTALLED") != "1", reason="HH_EXUDYN_TEST_INSTALLED=1 is not set"
)
@pytest.mark.parametrize("name", ["hh_exudyn", "vehicles", "track", "damage"])
def test_package_comes_from_site_packages(name: str) -> None:
    file = importlib.import_module(name).__file__
    assert file is not None
    assert Path(file).resolve().is_relative_to(Path(sysconfig.get_path("purelib")).resolve())


@pytest.mark.parametrize(
    "package, file",
    [
        ("hh_exudyn", "demo.toml"),
        ("hh_exudyn", "validation/creep_forces.csv"),
        ("hh_exudyn", "validation/stress_fields.npz"),
        ("vehicles", "iore_wagon.toml"),
        ("track", "flexibility.toml"),
        ("damage", "wear.toml"),
    ],
)
def test_data_files_are_in_the_packages(package: str, file: str) -> None:
    assert (resources.files(package) / "data" / file).is_file()
