"""The house of the project, held by machine: who may import whom, and the shape of the source tree.

`violations` walks the syntax trees of the project's files; the second half of the file shows on small trees
that every rule can fail. The project's files are what git tracks (or is about to: the index), in an unpacked
sdist what its SOURCES.txt lists. Whatever else lies in the folder - the demo's output, runs, a build, notes -
is its owner's business.
"""

import ast
import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("hh_exudyn", "vehicles", "track", "damage")
TOP_LEVEL = {
    *PACKAGES, "tests", "examples", "pyproject.toml",
    "README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md",
}  # fmt: skip
IN_SDIST = {"PKG-INFO", "setup.cfg"}  # what setuptools adds to an sdist, beside its egg-info
LINES = 400

BASE = (  # everything may import these
    "hh_exudyn", "hh_exudyn.arrays", "hh_exudyn.conventions", "hh_exudyn.entry_points", "hh_exudyn.glossary",
    "hh_exudyn.kernel", "hh_exudyn.lanes", "hh_exudyn.number_lines", "hh_exudyn.signals", "hh_exudyn.sourced",
    "hh_exudyn.text_files", "hh_exudyn.workers",
)  # fmt: skip
MAY_IMPORT = {  # part: parts it may import beside itself and BASE; a part is named by its prefix
    "hh_exudyn.contact": (),
    "hh_exudyn.log": (),
    "vehicles": ("hh_exudyn.contact.profile",),
    "track": ("hh_exudyn.contact.profile", "hh_exudyn.contact.friction"),
    "damage": ("hh_exudyn.contact", "hh_exudyn.log"),
    "hh_exudyn.case": ("vehicles", "track", "hh_exudyn.contact"),
    "hh_exudyn.multibody": ("hh_exudyn.case", "vehicles", "track", "hh_exudyn.contact", "hh_exudyn.log"),
    "hh_exudyn.campaign": (
        "hh_exudyn.case", "hh_exudyn.multibody", "hh_exudyn.contact", "hh_exudyn.log", "damage", "vehicles",
        "track",
    ),
    "hh_exudyn.assessment": ("hh_exudyn.log", "hh_exudyn.case", "hh_exudyn.contact", "vehicles", "track"),
    "hh_exudyn.figures": ("hh_exudyn.contact", "hh_exudyn.assessment", "track", "vehicles"),
    "hh_exudyn.playback": (
        "hh_exudyn.log", "hh_exudyn.case", "hh_exudyn.contact", "damage", "vehicles", "track",
    ),
    "hh_exudyn.cli": PACKAGES,
    "hh_exudyn.__main__": ("hh_exudyn.cli",),
    "hh_exudyn.arrays": (),
    "hh_exudyn.conventions": (),
    "hh_exudyn.entry_points": (),
    "hh_exudyn.glossary": (),
    "hh_exudyn.kernel": (),
    "hh_exudyn.lanes": (),
    "hh_exudyn.signals": (),
    "hh_exudyn.sourced": (),
    "hh_exudyn.text_files": (),
    "hh_exudyn.number_lines": (),
    "hh_exudyn.workers": (),
    "hh_exudyn": (),  # the package itself
}  # fmt: skip
ONLY_IN = {"exudyn": "hh_exudyn.multibody", "numba": "hh_exudyn.kernel"}


def within(module: str, part: str) -> bool:
    """Whether a module is a part or lies in it; the package `hh_exudyn` means its own file only."""
    return module == part or (part != "hh_exudyn" and module.startswith(part + "."))


def git(root: Path, *words: str) -> str:
    """What git says about the repository at `root`, wherever a hook that calls the tests may stand."""
    env = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    trusted = ["-c", "safe.directory=*"]  # also of another user: it is only read, and its code runs anyway
    return subprocess.run(
        ["git", *trusted, "-C", str(root), *words], env=env, check=True, capture_output=True, text=True
    ).stdout


def project_files(root: Path) -> list[str]:
    """The project's files at `root`, relative, with slashes: tracked by git, else listed in an sdist.

    Raises
    ------
    FileNotFoundError
        Where neither says what belongs to the project (an archive without its repository, not installed).
    """
    if (root / ".git").exists() and shutil.which("git"):
        listed = git(root, "ls-files", "-z").split("\0")
    else:
        lists = sorted(root.glob("*.egg-info/SOURCES.txt"))
        if not lists:
            raise FileNotFoundError(f"{root} is no git repository (or git is not there) and no sdist")
        listed = lists[0].read_text().splitlines()
    # a file that was deleted stays in the index until that is staged
    return sorted(name for name in listed if (root / name).is_file())


def modules_of(root: Path, files: list[str]) -> dict[str, Path]:
    """All modules of the packages by dotted name."""
    found = {}
    for name in files:
        parts = Path(name).with_suffix("").parts
        if name.endswith(".py") and parts[0] in PACKAGES:
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = root / name
    return found


def imports_of(path: Path, module: str, known: set[str]) -> tuple[set[str], list[str]]:
    """Modules that a file imports anywhere in it, and its star and relative imports."""
    found, bad = set(), []
    for node in ast.walk(ast.parse(path.read_text(), filename=str(path))):
        if isinstance(node, ast.Import):
            found |= {name.name for name in node.names}
        elif isinstance(node, ast.ImportFrom):
            source = node.module or ""
            if node.level:
                bad.append(f"{module}: relative import, line {node.lineno}")
            for name in node.names:
                if name.name == "*":
                    bad.append(f"{module}: star import from {source}")
                full = f"{source}.{name.name}"
                found.add(full if full in known else source)
    return found, bad


def cycle_in(graph: dict[str, set[str]]) -> list[str]:
    """One import cycle, or nothing."""
    done: set[str] = set()

    def visit(node: str, trail: list[str]) -> list[str]:
        if node in trail:
            return [*trail[trail.index(node) :], node]
        if node in done:
            return []
        for target in sorted(graph[node]):
            if cycle := visit(target, [*trail, node]):
                return cycle
        done.add(node)
        return []

    return next((cycle for node in sorted(graph) if (cycle := visit(node, []))), [])


def violations(root: Path, files: list[str]) -> list[str]:
    """Every breach of the house rules in the project's files, relative to `root`."""
    modules = modules_of(root, files)
    graph, found = {}, []
    for module, path in modules.items():
        targets, bad = imports_of(path, module, set(modules))
        found += bad
        graph[module] = {target for target in targets if target in modules and target != module}
        part = max((part for part in MAY_IMPORT if within(module, part)), key=len, default="")
        if not part:
            found.append(f"{module}: has no place in the import table")
            continue
        for target in sorted(targets):
            name = target.split(".")[0]
            if name in ONLY_IN and not within(module, ONLY_IN[name]):
                found.append(f"{module}: imports {name}, only {ONLY_IN[name]} may")
            allowed = (part, *BASE, *MAY_IMPORT[part])
            whole = part == "hh_exudyn.cli" and name in PACKAGES
            if name in PACKAGES and not whole and not any(within(target, other) for other in allowed):
                found.append(f"{module}: imports {target}")
        if "utils" in path.stem or "helpers" in path.stem:
            found.append(f"{module}: name a file after the thing, not {path.stem}")
        if (length := len(path.read_text().splitlines())) > LINES:
            found.append(f"{module}: {length} lines, at most {LINES}")
    if cycle := cycle_in(graph):
        found.append("import cycle: " + " -> ".join(cycle))
    for entry in sorted({Path(name).parts[0] for name in files}):
        known = entry in TOP_LEVEL | IN_SDIST
        if not known and not entry.startswith(".") and not entry.endswith(".egg-info"):
            found.append(f"{entry}: nothing else belongs at the top level")
    return found


@pytest.fixture(scope="module")
def files() -> list[str]:
    """The files of this project."""
    try:
        return project_files(ROOT)
    except FileNotFoundError as error:
        pytest.skip(f"nothing says which files are the project's: {error}")


def test_house_rules_hold(files: list[str]) -> None:
    assert len(modules_of(ROOT, files)) > 100
    assert violations(ROOT, files) == []


def test_examples_are_numbered_and_short(files: list[str]) -> None:
    for path in (ROOT / name for name in files if name.startswith("examples/") and name.endswith(".py")):
        assert path.name[:2].isdigit(), path.name
        assert len(path.read_text().splitlines()) < 60, path.name


CLEAN = {
    "hh_exudyn/__init__.py": "",
    "hh_exudyn/kernel.py": "import numba",
    "hh_exudyn/contact/__init__.py": "",
    "hh_exudyn/contact/profile.py": "from hh_exudyn.kernel import kernel",
    "hh_exudyn/multibody/assembly.py": "import exudyn",
    "track/rails.py": "from hh_exudyn.contact.profile import rail_profile",
    "damage/wear.py": "import hh_exudyn.contact.profile",
    "hh_exudyn/cli/app.py": "from hh_exudyn import __version__\nfrom damage import wear",
}
BREACHES = {
    "contact imports damage": ({"hh_exudyn/contact/hertz.py": "from damage import wear"}, "imports damage"),
    "inside a function": ({"track/a.py": "def f():\n    import vehicles.wagon"}, "imports vehicles"),
    "more of contact": (
        {"track/a.py": "import hh_exudyn.contact.search"},
        "imports hh_exudyn.contact.search",
    ),
    "exudyn elsewhere": ({"vehicles/a.py": "import exudyn.utilities"}, "only hh_exudyn.multibody may"),
    "numba elsewhere": ({"vehicles/a.py": "from numba import njit"}, "only hh_exudyn.kernel may"),
    "star": ({"damage/a.py": "from numpy import *"}, "star import"),
    "relative": ({"damage/a.py": "from . import wear"}, "relative import"),
    "utils": ({"damage/plot_utils.py": ""}, "name a file after the thing"),
    "long file": ({"damage/a.py": "x = 1\n" * (LINES + 1)}, "401 lines"),
    "cycle": ({"track/a.py": "import track.b", "track/b.py": "from track import a"}, "import cycle: track.a"),
    "no place": ({"hh_exudyn/odd.py": ""}, "hh_exudyn.odd: has no place"),
    "top level": ({"scripts/a.py": ""}, "scripts: nothing else belongs"),
}


def tree(root: Path, texts: dict[str, str]) -> list[str]:
    """Write files; their names."""
    for name, text in texts.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return sorted(texts)


def test_clean_tree_passes(tmp_path: Path) -> None:
    assert violations(tmp_path, tree(tmp_path, CLEAN)) == []


@pytest.mark.parametrize("name", BREACHES)
def test_breach_is_found(tmp_path: Path, name: str) -> None:
    texts, message = BREACHES[name]
    found = violations(tmp_path, tree(tmp_path, CLEAN | texts))
    assert len(found) == 1
    assert message in found[0]


LEFT_LYING = {  # by the demo, by pip, by the user
    "demo/case.toml": "",
    "runs/notes.md": "",
    "notes.txt": "",
    "build/lib/track/gone.py": "from . import gone",
    "track/draft.py": "import exudyn",
}


@pytest.mark.skipif(not shutil.which("git"), reason="git is not there")
def test_of_a_repository_only_what_git_tracks_counts(tmp_path: Path) -> None:
    """Untracked files are left alone, ignored or not; a file counts from `git add` on."""
    git(tmp_path, "init", "--quiet")
    tracked = tree(tmp_path, CLEAN)
    git(tmp_path, "add", ".")
    tree(tmp_path, LEFT_LYING)
    assert project_files(tmp_path) == tracked
    assert violations(tmp_path, project_files(tmp_path)) == []
    git(tmp_path, "add", "notes.txt", "track/draft.py")
    found = violations(tmp_path, project_files(tmp_path))
    assert [line.split(":")[0] for line in found] == ["track.draft", "notes.txt"]
    (tmp_path / "notes.txt").unlink()
    assert "notes.txt" not in project_files(tmp_path)


def test_of_an_unpacked_sdist_only_what_it_lists_counts(tmp_path: Path) -> None:
    listed = tree(tmp_path, CLEAN | {"PKG-INFO": "", "setup.cfg": "", "hh_exudyn.egg-info/PKG-INFO": ""})
    listed += ["hh_exudyn.egg-info/SOURCES.txt"]
    tree(tmp_path, {listed[-1]: "\n".join(listed)} | LEFT_LYING)
    assert project_files(tmp_path) == sorted(listed)
    assert violations(tmp_path, project_files(tmp_path)) == []
    tree(tmp_path, {listed[-1]: "\n".join([*listed, "runs/notes.md"])})
    assert violations(tmp_path, project_files(tmp_path)) == ["runs: nothing else belongs at the top level"]


def test_where_nothing_lists_the_files_that_is_said(tmp_path: Path) -> None:
    tree(tmp_path, CLEAN)
    with pytest.raises(FileNotFoundError, match="no git repository"):
        project_files(tmp_path)
