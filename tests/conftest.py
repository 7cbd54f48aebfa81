"""Settings of all tests: one thread everywhere, no windows, the folders of outside data."""

import os
import sys
from pathlib import Path

import pytest
from hypothesis import settings

for _name in ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")  # before numpy and numba are imported; also for child processes
os.environ.setdefault("MPLBACKEND", "Agg")

settings.register_profile("unhurried", deadline=None)  # no test asserts a time: a loaded machine is slow
settings.load_profile("unhurried")

REPOSITORY = Path(__file__).resolve().parents[1]


def pytest_configure(config: pytest.Config) -> None:
    """With HH_EXUDYN_TEST_INSTALLED=1 the tests are for the installed packages, never for the checkout.

    ``python -m pytest`` puts the checkout first in `sys.path`, where its folders would shadow them.
    """
    if os.environ.get("HH_EXUDYN_TEST_INSTALLED") == "1":
        paths = {Path(entry or ".").resolve() for entry in sys.path}
        if REPOSITORY in paths:
            raise pytest.UsageError(f"{REPOSITORY} is in sys.path: run `pytest`, not `python -m pytest`")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what reads files of others, so that `.ci/run` can run just these where the files are."""
    for item in items:
        if {"shared_profiles", "shared_cases", "shared_reference"} & set(getattr(item, "fixturenames", ())):
            item.add_marker(pytest.mark.shared)


@pytest.fixture(scope="session")
def shared_profiles() -> Path:
    """The folder of profiles made by others, which may not stand in the repository.

    The test is skipped where the folder is absent, as on a fresh machine; what the test holds of the code is
    held there by a test of a shape of our own.
    """
    folder = REPOSITORY.parent / "shared" / "profiles"
    if not folder.is_dir():
        pytest.skip(
            "reads a profile made by others, which may not stand in the repository: no ../shared/profiles"
        )
    return folder


@pytest.fixture(scope="session")
def shared_cases() -> Path:
    """The folder of small inputs with right answers; as `shared_profiles`, tests of our own hold the same."""
    folder = REPOSITORY.parent / "shared" / "cases"
    if not folder.is_dir():
        pytest.skip("reads an input that may not stand in the repository: no ../shared/cases")
    return folder


@pytest.fixture(scope="session")
def shared_reference() -> Path:
    """The folder of facts from other programs; the tests that read it compare, they hold no code alone."""
    folder = REPOSITORY.parent / "shared" / "reference"
    if not folder.is_dir():
        pytest.skip("compares with another program's results: no ../shared/reference")
    return folder
