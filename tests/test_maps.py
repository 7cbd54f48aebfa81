"""Every folder's docstring is its map, and what stands in backticks is there."""

import ast
import re
import tokenize
from pathlib import Path

import pytest
from names import defined_names, resolves
from test_architecture import PACKAGES, modules_of, project_files

ROOT = Path(__file__).resolve().parents[1]
DOTTED = re.compile(r"(?<!`)`([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)+)`(?!`)")
FILES = (".py", ".toml", ".csv", ".npz", ".md", ".json", ".parquet", ".png", ".rrd", ".txt")
OTHERS = {  # packages of others, and the names by which they are imported
    "numpy", "np", "scipy", "numba", "pyarrow", "pydantic", "exudyn", "exu", "trimesh", "rerun", "rr", "math",
    "importlib", "typing", "matplotlib", "typer",
}  # fmt: skip


@pytest.fixture(scope="module")
def modules() -> dict[str, Path]:
    try:
        return modules_of(ROOT, project_files(ROOT))
    except FileNotFoundError as error:
        pytest.skip(f"nothing says which files are the project's: {error}")


def texts(path: Path) -> list[tuple[int, str]]:
    """Docstrings and comments of a file, with the line where each begins."""
    source = path.read_text()
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node):
            found.append((node.body[0].lineno, ast.get_docstring(node) or ""))
    with path.open("rb") as stream:
        for token in tokenize.tokenize(stream.readline):
            if token.type == tokenize.COMMENT:
                found.append((token.start[0], token.string))
    return found


def arguments(path: Path) -> set[str]:
    """Names of arguments of the functions of a file: their attributes are not followed."""
    nodes = ast.walk(ast.parse(path.read_text()))
    return {
        arg.arg for node in nodes if isinstance(node, ast.arguments) for arg in (*node.args, *node.kwonlyargs)
    }


def unnamed_files(path: Path) -> list[str]:
    """Files and folders beside an `__init__` that its docstring does not name."""
    text = ast.get_docstring(ast.parse(path.read_text())) or ""
    named = {name.split(".")[-1] for name in re.findall(r"`([\w.]+)`", text)}
    beside = {
        item.stem for item in path.parent.iterdir() if item.suffix == ".py" or (item / "__init__.py").exists()
    }
    return sorted(beside - {"__init__", "__main__"} - named)


def test_every_map_names_every_file(modules: dict[str, Path]) -> None:
    maps = {module: path for module, path in modules.items() if path.name == "__init__.py"}
    assert len(maps) > 20
    missing = {module: unnamed_files(path) for module, path in maps.items() if unnamed_files(path)}
    assert missing == {}


def test_every_dotted_name_in_backticks_is_there(modules: dict[str, Path]) -> None:
    names = defined_names(modules)
    dead = []
    for module, path in modules.items():
        others = OTHERS | arguments(path)
        for line, text in texts(path):
            for dotted in DOTTED.findall(text):
                root = dotted.split(".")[0]
                known = dotted.endswith(FILES) or root in others
                if not known and not resolves(dotted, module, names):
                    dead.append(f"{path.relative_to(ROOT)}:{line}: {dotted}")
    assert dead == []


def test_a_dead_name_and_a_missing_file_are_found(tmp_path: Path) -> None:
    package = tmp_path / "damage"
    package.mkdir()
    (package / "__init__.py").write_text('"""The map: `wear`."""\n')
    (package / "wear.py").write_text("class Law:\n    rate = 1.0\n\ndef depth(x): ...\n")
    (package / "rcf.py").write_text("from damage.wear import Law\n")
    modules = modules_of(tmp_path, ["damage/__init__.py", "damage/wear.py", "damage/rcf.py"])
    assert unnamed_files(package / "__init__.py") == ["rcf"]
    names = defined_names(modules)
    for alive in ("wear.depth", "damage.wear.Law.rate", "Law.rate", "damage.wear"):
        assert resolves(alive, "damage.rcf", names), alive
    for dead in ("wear.speed", "damage.crack", "Law.speed"):
        assert not resolves(dead, "damage.rcf", names), dead


def test_packages_have_maps(modules: dict[str, Path]) -> None:
    assert set(PACKAGES) <= set(modules)
