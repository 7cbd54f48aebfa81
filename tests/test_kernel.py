"""The kernel decorator and its cache: never stale, never in the way."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from hh_exudyn import kernel

SOURCES = {  # a small project with a kernel that calls a kernel in another file
    "hh_exudyn/__init__.py": "",
    "hh_exudyn/conventions.py": "GRAVITY = 9.81",
    "hh_exudyn/contact/__init__.py": "",
    "hh_exudyn/contact/inner.py": """
from hh_exudyn.kernel import kernel

@kernel
def inner(x):
    return 2.0 * x
""",
    "hh_exudyn/contact/outer.py": """
from hh_exudyn.contact.inner import inner
from hh_exudyn.kernel import kernel

@kernel
def outer(x):
    return inner(x) + 1.0
""",
    "vehicles/wedge.py": "STIFFNESS = 1.0",
    "track/ballast.py": "STIFFNESS = 1.0",
    "damage/rcf.py": "STRENGTH = 1.0",
    "damage/wear/values.py": "HARDNESS = 1.0",
    "README.md": "words",
}
CALL = """
from hh_exudyn.contact.outer import outer
value = outer(3.0)
print(value, sum(outer.stats.cache_hits.values()) if hasattr(outer, "stats") else -1)
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    root = tmp_path / "project"
    for name, text in SOURCES.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    shutil.copy(kernel.__file__, root / "hh_exudyn" / "kernel.py")
    return root


def run(root: Path, code: str, cache: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run code in a fresh process that sees only the project at `root`."""
    env = os.environ | {"PYTHONPATH": str(root), "XDG_CACHE_HOME": str(cache)} | environment
    env.pop("NUMBA_CACHE_DIR", None)
    return subprocess.run([sys.executable, "-c", code], cwd=root, env=env, capture_output=True, text=True)


@pytest.mark.parametrize(
    "name",
    ["hh_exudyn/kernel.py", "hh_exudyn/conventions.py", "hh_exudyn/contact/inner.py", "vehicles/wedge.py",
     "track/ballast.py", "damage/rcf.py", "damage/wear/values.py"],
)  # fmt: skip
def test_hash_follows_every_kernel_source(project: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel, "_ROOT", project)
    before = kernel.source_hash()
    assert before == kernel.source_hash()
    (project / name).write_text((project / name).read_text() + "\n# changed\n")
    assert kernel.source_hash() != before


def test_hash_sees_new_and_renamed_files_only_among_sources(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kernel, "_ROOT", project)
    first = kernel.source_hash()
    (project / "README.md").write_text("other words")
    assert kernel.source_hash() == first
    (project / "track" / "ballast.py").rename(project / "track" / "bed.py")
    assert kernel.source_hash() != first


def test_changed_inner_kernel_is_never_stale(project: Path, tmp_path: Path) -> None:
    """The fault the decorator exists for: numba alone would answer 7 again after the change."""
    cache = tmp_path / "cache"
    first, again = run(project, CALL, cache), run(project, CALL, cache)
    assert first.stdout.split() == ["7.0", "0"], first.stderr
    assert again.stdout.split() == ["7.0", "1"], again.stderr  # from the cache
    inner = project / "hh_exudyn/contact/inner.py"
    inner.write_text(inner.read_text().replace("2.0", "5.0"))
    changed = run(project, CALL, cache)
    assert changed.stdout.split() == ["16.0", "0"], changed.stderr


def test_cache_that_cannot_be_written_falls_back_with_one_warning(project: Path, tmp_path: Path) -> None:
    blocked = tmp_path / "a-file"  # a file where a folder is needed: refused to root as well
    blocked.write_text("")
    result = run(project, CALL, blocked)
    assert result.stdout.split() == ["7.0", "0"], result.stderr
    assert result.stderr.count("RuntimeWarning") == 1
    assert "XDG_CACHE_HOME" in result.stderr


def test_kernels_run_as_plain_python(project: Path, tmp_path: Path) -> None:
    result = run(project, CALL, tmp_path / "cache", NUMBA_DISABLE_JIT="1")
    assert result.stdout.split() == ["7.0", "-1"], result.stderr


def test_division_by_zero_is_infinite_as_in_numpy(project: Path, tmp_path: Path) -> None:
    (project / "hh_exudyn/contact/inverse.py").write_text(
        "from hh_exudyn.kernel import kernel\n\n@kernel\ndef inverse(x):\n    return 1.0 / x\n"
    )
    code = "from hh_exudyn.contact.inverse import inverse\nprint(inverse(0.0))"
    result = run(project, code, tmp_path / "cache")
    assert result.stdout.strip() == "inf", result.stderr
