"""Numbers in lines of text as people's programs write them: separators, decimal commas, Fortran's exponents.

Columns stand between blanks, tabs, semicolons or commas. A comma is a decimal comma where other separators
stand between the columns and it has digits on both sides (``-58,0000;2,5023``); in ``-58.0,2.5`` it
separates. A number may have the exponent ``D`` of Fortran (1.0D-3) and the minus sign of typography.
"""

import re

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_COMMA_INSIDE = re.compile(r"\d,\d")
_EXPONENT = str.maketrans("dD", "ee")


def number(word: str) -> float | None:
    """A word as a number, perhaps not a finite one; None where it is none."""
    if word.isascii() and "_" not in word:  # as most are: 1_000 is a number of Python's only
        try:
            return float(word)
        except ValueError:
            pass
    word = word.replace("\N{MINUS SIGN}", "-")
    if _NUMBER.fullmatch(word):
        return float(word.translate(_EXPONENT))
    return float(word) if _NOT_FINITE.fullmatch(word) else None


def has_decimal_commas(lines: list[str]) -> bool:
    """Whether the commas in lines of numbers are decimal commas.

    Raises
    ------
    ValueError
        Four columns or more of digits with commas alone: ``1,5,2,5`` is two numbers or four.
    """
    decimal = False
    for line in lines:
        if not _COMMA_INSIDE.search(line):
            continue
        words = [word.strip(",") for word in re.split(r"[;\s]+", line.strip()) if word.strip(",")]
        inside = [word for word in words if _COMMA_INSIDE.search(word)]
        if any("." in word or word.count(",") > 1 for word in inside):
            if len(words) == 1 and "." not in words[0] and words[0].count(",") == 3:
                raise ValueError(
                    f"{line.strip()[:40]!r} is two numbers or four; allowed with a decimal comma are columns "
                    "between semicolons, tabs or blanks"
                )
            return False
        elif len(words) > 1:
            decimal = True
    return decimal


def words(line: str, decimal_commas: bool = False) -> list[str]:
    """The columns of a line, a decimal comma as a point.

    Parameters
    ----------
    line : str
        The line.
    decimal_commas : bool
        Of `has_decimal_commas`.
    """
    if decimal_commas:
        line = re.sub(r"(?<=\d),(?=\d)", ".", line)
    return line.replace(",", " ").replace(";", " ").split()


def leading_numbers(line: str, decimal_commas: bool = False) -> tuple[list[float], list[str]]:
    """The numbers that a line begins with, and the words behind them.

    Parameters
    ----------
    line, decimal_commas
        As for `words`.
    """
    found = words(line, decimal_commas)
    values: list[float] = []
    for word in found:
        value = number(word)
        if value is None:
            break
        values.append(value)
    return values, found[len(values) :]
