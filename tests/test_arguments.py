"""Argument lists are short, and where they are not, the docstring says how long they are and why."""

import ast
import re
from pathlib import Path

import pytest
from test_architecture import modules_of, project_files

ROOT = Path(__file__).resolve().parents[1]
PUBLIC, KERNEL = 8, 10  # arguments that need no reason
KERNELS = {"kernel", "inlined_kernel"}
WORDS = (
    "nine", "ten", "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen",
    "nineteen", "twenty",
)  # fmt: skip
REASON = r" arguments: \w+\W+\w+\W+\w+"  # three words at least


def functions(body: list[ast.stmt]) -> list[ast.FunctionDef]:
    """Functions of a module, and methods of its public classes."""
    found = [node for node in body if isinstance(node, ast.FunctionDef)]
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            found += functions(node.body)
    return found


def long_lists(path: Path) -> list[str]:
    """Functions with more arguments than need no reason, and without one."""
    found = []
    for node in functions(ast.parse(path.read_text()).body):
        every = (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)
        names = [arg.arg for arg in every if arg.arg not in ("self", "cls")]
        is_kernel = any(ast.unparse(decorator).split(".")[-1] in KERNELS for decorator in node.decorator_list)
        if not is_kernel and node.name.startswith("_"):
            continue
        if len(names) > (KERNEL if is_kernel else PUBLIC):
            words = [WORDS[len(names) - 9]] if len(names) < 9 + len(WORDS) else []
            text = " ".join((ast.get_docstring(node) or "").split())
            if not any(re.search(rf"\b{word}{REASON}", text, re.IGNORECASE) for word in words):
                found.append(f"{path.name}:{node.lineno}: {node.name} has {len(names)} arguments")
    return found


def test_long_argument_lists_say_why() -> None:
    try:
        modules = modules_of(ROOT, project_files(ROOT))
    except FileNotFoundError as error:
        pytest.skip(f"nothing says which files are the project's: {error}")
    assert len(modules) > 100
    assert [line for path in modules.values() for line in long_lists(path)] == []


NINE = "(a, b, c, d, e, f, g, h, i)"
ELEVEN = "(a, b, c, d, e, f, g, h, *, i, j, k)"
CASES = {
    "no docstring": (f"def force{NINE}: ...", 1),
    "no reason": (f"def force{NINE}:\n    '''Nine arguments.'''", 1),
    "wrong number": (f"def force{NINE}:\n    '''Ten arguments: those of the standard.'''", 1),
    "method": (f"class Law:\n    def force(self, {NINE[1:]}: ...", 1),
    "long kernel": (f"@kernel\ndef _force{ELEVEN}: ...", 1),
    "a reason": (f"def force{NINE}:\n    '''Force.\n\n    Nine arguments: those of\n    the law.'''", 0),
    "kernel": (f"@inlined_kernel\ndef force{NINE}: ...", 0),
    "own": (f"def _force{ELEVEN}: ...", 0),
    "eight": ("class Law:\n    def force(self, a, b, c, d, e, f, g, h): ...", 0),
}


@pytest.mark.parametrize("name", CASES)
def test_a_long_argument_list_is_found(tmp_path: Path, name: str) -> None:
    text, count = CASES[name]
    (tmp_path / "law.py").write_text(text)
    assert len(long_lists(tmp_path / "law.py")) == count
