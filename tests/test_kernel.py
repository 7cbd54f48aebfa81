"""The kernel decorator and its cache: never stale, never in the way."""

import ast
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from test_architecture import imports_of

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


def test_every_module_that_imports_the_kernel_is_hashed_with_all_that_it_imports() -> None:
    """The project's own imports, from every module with kernels on, lie in what its cache is named by."""
    root = kernel._ROOT
    found = [path for package in kernel._PACKAGES for path in (root / package).rglob("*.py")]
    modules = {".".join(path.relative_to(root).with_suffix("").parts).removesuffix(".__init__"): path
               for path in found}  # fmt: skip
    graph = {module: imports_of(path, module, set(modules))[0] & set(modules)
             for module, path in modules.items()}  # fmt: skip
    with_kernels = [module for module, targets in graph.items() if "hh_exudyn.kernel" in targets]
    assert len(with_kernels) > 50
    for module in with_kernels:
        part = kernel._part_of(module)
        patterns = (*kernel._BASE, *kernel._PARTS[part]) if part else kernel._EVERYTHING
        hashed = {path for pattern in patterns for path in root.glob(pattern)}
        reached, waiting = set(), [module]
        while waiting:
            name = waiting.pop()
            if name not in reached:
                reached.add(name)
                waiting += graph[name]
        assert {modules[name] for name in reached} <= hashed, module


def test_a_kernel_in_a_subfolder_is_never_stale(project: Path, tmp_path: Path) -> None:
    deep = project / "hh_exudyn/contact/geometry/inner.py"
    deep.parent.mkdir()
    (deep.parent / "__init__.py").touch()
    deep.write_text((project / "hh_exudyn/contact/inner.py").read_text())
    outer = project / "hh_exudyn/contact/outer.py"
    outer.write_text(outer.read_text().replace("contact.inner", "contact.geometry.inner"))
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["7.0", "0"]
    deep.write_text(deep.read_text().replace("2.0", "20.0"))
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["61.0", "0"]


def test_a_part_is_compiled_anew_only_for_what_it_can_be_made_of(project: Path, tmp_path: Path) -> None:
    """Damage and the command line are above the contact: its kernels stay."""
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["7.0", "0"]
    for name in ("damage/rcf.py", "vehicles/wedge.py", "hh_exudyn/cli/app.py"):
        (project / name).parent.mkdir(exist_ok=True)
        (project / name).write_text("CHANGED = 1.0")
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["7.0", "1"]


def test_unused_caches_are_deleted(project: Path, tmp_path: Path) -> None:
    base = tmp_path / "cache" / "hh_exudyn"
    ages = {"ancient": 20 * 24 * 3600.0, "recent": 3600.0} | {f"many_{k}": 7200.0 + k for k in range(60)}
    for name, age in ages.items():
        (base / name).mkdir(parents=True)
        (base / name / "index").touch()
        os.utime(base / name, (time.time() - age,) * 2)
    assert run(project, CALL, tmp_path / "cache").returncode == 0
    left = {folder.name for folder in base.iterdir()}
    assert "ancient" not in left and "recent" in left
    assert "many_0" in left and "many_59" not in left
    assert len(left) < 50


def test_compiling_at_once_and_being_killed_leave_a_sound_cache(project: Path, tmp_path: Path) -> None:
    env = os.environ | {"PYTHONPATH": str(project), "XDG_CACHE_HOME": str(tmp_path / "cache")}
    env.pop("NUMBA_CACHE_DIR", None)
    start = [sys.executable, "-c", CALL]
    processes = [
        subprocess.Popen(start, cwd=project, env=env, stdout=subprocess.PIPE, text=True) for _ in range(4)
    ]
    folder = tmp_path / "cache" / "hh_exudyn"
    for _ in range(600):  # until the first has begun to write
        if any(folder.rglob("*.nb?")) or processes[0].poll() is not None:
            break
        time.sleep(0.05)
    processes[0].kill()
    for process in processes[1:]:
        assert process.communicate()[0].split()[0] == "7.0"
    processes[0].communicate()
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["7.0", "1"]


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


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def _hole(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2 : len(content) // 2 + 64] = bytes(64)
    path.write_bytes(content)


def _empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize(
    ("suffix", "breaking"),
    [(".nbi", _cut), (".nbi", _empty), (".nbc", _cut), (".nbc", _hole), (".nbc", _empty)],
)
def test_broken_cache_is_compiled_again_with_one_warning(
    project: Path, tmp_path: Path, suffix: str, breaking: Callable[[Path], None]
) -> None:
    cache = tmp_path / "cache"
    run(project, CALL, cache)
    files = [path for path in cache.rglob("*") if path.suffix == suffix]
    assert len(files) == 2  # of two kernels
    for path in files:
        breaking(path)
    broken = run(project, CALL, cache)
    assert broken.stdout.split() == ["7.0", "0"], broken.stderr
    assert broken.stderr.count("RuntimeWarning") == 1
    assert "is broken" in broken.stderr
    after = run(project, CALL, cache)
    assert after.stdout.split() == ["7.0", "1"]
    assert after.stderr == ""


def test_full_disk_falls_back_to_no_cache_with_one_warning(project: Path, tmp_path: Path) -> None:
    limit = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
    result = run(project, limit + CALL, tmp_path / "cache")
    assert result.stdout.split() == ["7.0", "0"], result.stderr
    assert result.stderr.count("RuntimeWarning") == 1
    assert "cannot be written" in result.stderr
    assert run(project, CALL, tmp_path / "cache").stdout.split() == ["7.0", "0"]


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


def test_a_kernel_that_allocates_is_refused_when_compiled(project: Path, tmp_path: Path) -> None:
    (project / "hh_exudyn/contact/inner.py").write_text(
        """
import numpy as np
from hh_exudyn.kernel import kernel

@kernel
def inner(x):
    return np.zeros(3)[0] + x
"""
    )
    result = run(project, CALL, tmp_path / "cache")
    assert result.returncode != 0
    assert "NRT required but not enabled" in result.stderr or "array passed into" in result.stderr


def test_what_allocates_calls_no_kernel_that_returns_arrays() -> None:
    """Such a kernel does not count its references, its caller would take one away: memory in use is freed."""
    numbers = {"float", "int", "bool", "None", "tuple", "Triple", "Quadruple", "Trouble"}
    returns: dict[str, set[str]] = {}
    allocating: list[ast.FunctionDef] = []
    for path in sorted(
        path for package in kernel._PACKAGES for path in (kernel._ROOT / package).rglob("*.py")
    ):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef):
                marks = {mark.id for mark in node.decorator_list if isinstance(mark, ast.Name)}
                if marks & {"kernel", "inlined_kernel"} and node.returns is not None:
                    names = {part.id for part in ast.walk(node.returns) if isinstance(part, ast.Name)}
                    returns[node.name] = returns.get(node.name, set()) | names
                if "allocating_kernel" in marks:
                    allocating.append(node)
    assert len(allocating) > 5
    for node in allocating:
        for call in ast.walk(node):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in returns:
                assert returns[call.func.id] <= numbers, f"{node.name} calls {call.func.id}"
