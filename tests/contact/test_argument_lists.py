"""Argument lists and lengths of the functions of contact and log."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2] / "hh_exudyn"
PUBLIC, KERNEL, LINES = 8, 10, 80
IN_WORDS = {9: "nine", 10: "ten", 11: "eleven", 12: "twelve", 17: "seventeen"}


def functions(text: str) -> list[ast.FunctionDef]:
    """All functions of a source."""
    return [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]


def arguments(function: ast.FunctionDef) -> int:
    """Number of arguments without `self`."""
    names = [
        item.arg for item in (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
    ]
    return len(names) - (names[:1] in (["self"], ["cls"]))


def unexplained(text: str) -> list[str]:
    """Functions with too many arguments that the docstring does not justify, and those too long."""
    found = []
    for function in functions(text):
        count = arguments(function)
        kernel = any("kernel" in ast.unparse(item) for item in function.decorator_list)
        words = (ast.get_docstring(function) or "").lower().split()
        if count > (KERNEL if kernel else PUBLIC) and IN_WORDS.get(count, "") not in words:
            found.append(f"{function.name}: {count} arguments")
        if (length := function.end_lineno - function.lineno + 1) > LINES:
            found.append(f"{function.name}: {length} lines")
    return found


@pytest.mark.parametrize("package", ["contact", "log"])
def test_long_argument_lists_say_why(package: str) -> None:
    for path in sorted((ROOT / package).rglob("*.py")):
        assert unexplained(path.read_text(encoding="utf-8")) == [], path


def test_a_breach_is_found() -> None:
    many = ", ".join(f"a{k}" for k in range(11))
    assert unexplained(f"def f({many}): ...") == ["f: 11 arguments"]
    assert unexplained(f"@kernel\ndef f({many}): ...") == ["f: 11 arguments"]
    assert unexplained(f'def f({many}):\n    """Eleven arguments: measured."""') == []
    assert unexplained("def f():\n" + "    x = 1\n" * 80) == ["f: 81 lines"]
