"""Which dotted names the project has: modules, what they define, what its classes have. Read from sources."""

import ast
from collections.abc import Iterator
from pathlib import Path

Names = dict[str, dict[str, set[str]]]  # module -> name it defines -> attributes, of a class


def defined_names(modules: dict[str, Path]) -> Names:
    """What every module defines or imports at its top level; of classes what they define, too."""
    return {module: dict(_top_level(ast.parse(path.read_text()).body)) for module, path in modules.items()}


def _top_level(body: list[ast.stmt]) -> Iterator[tuple[str, set[str]]]:
    for node in body:
        match node:
            case ast.ClassDef():
                yield node.name, set(_members(node))
            case ast.FunctionDef():
                yield node.name, set()
            case ast.If() | ast.Try():
                yield from _top_level(node.body)
            case _:
                for name in _bound(node):
                    yield name, set()


def _members(node: ast.ClassDef) -> Iterator[str]:
    for item in node.body:
        if isinstance(item, ast.FunctionDef | ast.ClassDef):
            yield item.name
            for inner in ast.walk(item):  # attributes that methods set
                if isinstance(inner, ast.Attribute) and isinstance(inner.ctx, ast.Store):
                    yield inner.attr
        else:
            yield from _bound(item)


def _bound(node: ast.stmt) -> Iterator[str]:
    match node:
        case ast.Import() | ast.ImportFrom():
            for alias in node.names:
                yield (alias.asname or alias.name).split(".")[0]
        case ast.Assign():
            for target in node.targets:
                yield from (name.id for name in ast.walk(target) if isinstance(name, ast.Name))
        case ast.AnnAssign() if isinstance(node.target, ast.Name):
            yield node.target.id


def resolves(dotted: str, where: str, names: Names) -> bool:
    """Whether a dotted name in a docstring of module `where` is something that the project has.

    It may be written from any of its packages on: `search.find_contacts` for
    `hh_exudyn.contact.geometry.search.find_contacts`; of a class in the same module, `Case.speed`.
    """
    parts = dotted.split(".")
    members = set().union(*(defined.get(parts[0], set()) for defined in names.values()))
    if members and len(parts) > 1 and parts[1] in members:  # of a class, wherever it is defined
        return True
    if parts[0] in names[where] and not members:  # a module or a function that is imported there
        return True
    for cut in range(len(parts), 0, -1):
        suffix, rest = ".".join(parts[:cut]), parts[cut:]
        for module, defined in names.items():
            if module != suffix and not module.endswith("." + suffix):
                continue
            if not rest:
                return True
            if rest[0] in defined and (len(rest) == 1 or rest[1] in defined[rest[0]] or not defined[rest[0]]):
                return True
    return False
