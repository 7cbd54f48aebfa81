"""The project's files, its modules, and what they import: for tests that read sources."""

import ast
import os
import shutil
import subprocess
from pathlib import Path

PACKAGES = ("hh_exudyn", "vehicles", "track", "damage")


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
