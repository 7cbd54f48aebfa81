"""Parts of a page that needs no other file: tables that sort at a click, and figures inside the page."""

import base64
import html
import io
import math
import re

import pyarrow
from matplotlib import rc_context
from matplotlib.figure import Figure

UNITS = {
    "um_per_1000_km": "µm per 1000 km", "_MPa": " [MPa]", "_mm": " [mm]", "_um": " [µm]", "_km": " [km]",
    "_percent": " [%]", "_deg": " [°]",
}  # fmt: skip
_DIGITS = {
    "um_per_1000_km": 3,
    "_MPa": 0,
    "_mm": 3,
    "_um": 2,
    "_km": 1,
    "_percent": 1,
    "_deg": 2,
}  # else four figures
STYLE = """
body { font: 10.5pt/1.4 system-ui, "Liberation Sans", Arial, sans-serif; color: #222;
       max-width: 190mm; margin: 8mm auto; padding: 0 4mm; }
h1 { font-size: 18pt; margin: 0 0 1mm; }
h2 { font-size: 13pt; margin: 8mm 0 2mm; border-bottom: 1px solid #999; }
h3 { font-size: 10.5pt; margin: 5mm 0 1mm; } p { margin: 1mm 0 2mm; }
table { border-collapse: collapse; font-size: 8pt; margin: 1mm 0 3mm; max-width: 100%; }
th, td { padding: 0.5mm 1.3mm; text-align: right; vertical-align: top; white-space: nowrap; }
th { border-bottom: 1px solid #222; vertical-align: bottom; cursor: pointer; white-space: normal; }
th[aria-sort=ascending]::after { content: " ▲"; } th[aria-sort=descending]::after { content: " ▼"; }
.text { text-align: left; white-space: normal; } tbody tr:nth-child(even) { background: #f4f4f4; }
figure { margin: 2mm 0 4mm; break-inside: avoid; } figure img { width: 100%; max-width: 178mm; }
figcaption { font-size: 8.5pt; color: #444; }
dt { font-weight: 600; float: left; clear: left; width: 26mm; }
dd { margin: 0 0 1mm 28mm; }
pre { font-size: 7.5pt; white-space: pre-wrap; background: #f4f4f4; padding: 2mm; }
.note { font-size: 9pt; color: #444; }
@page { size: A4; margin: 14mm; }
@media print { body { margin: 0; padding: 0; max-width: none; }
               h2, h3 { break-after: avoid; }
               tr { break-inside: avoid; } thead { display: table-header-group; } }
"""
SORTING = """
document.querySelectorAll("th").forEach(head => head.addEventListener("click", () => {
  const body = head.closest("table").tBodies[0], place = head.cellIndex;
  const down = head.getAttribute("aria-sort") === "ascending";
  head.parentNode.querySelectorAll("th").forEach(other => other.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", down ? "descending" : "ascending");
  const value = row => row.cells[place].dataset.value ?? row.cells[place].textContent;
  const compare = (one, two) => head.className === "text" ? one.localeCompare(two)
    : (one === "" ? -Infinity : Number(one)) - (two === "" ? -Infinity : Number(two));
  [...body.rows].sort((one, two) => (down ? -1 : 1) * compare(value(one), value(two)))
    .forEach(row => body.append(row));
}));
"""


def table_html(table: pyarrow.Table) -> str:
    """A table; a click on a heading sorts by its column.

    Parameters
    ----------
    table
        Units of numbers in the names of the columns, as `diameter_mm`.
    """
    texts = [_is_text(column.type) for column in table.columns]
    heads = "".join(
        f"<th{_class(text)}>{html.escape(heading(name))}</th>"
        for name, text in zip(table.column_names, texts, strict=True)
    )
    rows = []
    for row in table.to_pylist():
        cells = []
        for (name, value), text in zip(row.items(), texts, strict=True):
            if text:
                cells.append(f'<td class="text">{_breakable(cell_text(name, value))}</td>')
            else:
                exact = "" if _missing(value) else repr(value)
                cells.append(f'<td data-value="{exact}">{number_text(name, value)}</td>')
        rows.append(f"<tr>{''.join(cells)}</tr>")
    return f"<table><thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def figure_html(figure: Figure, caption: str) -> str:
    """A figure as an image inside the page, which keeps its lines sharp in print.

    Parameters
    ----------
    figure
        Any.
    caption
        Below it.
    """
    stream = io.BytesIO()
    with rc_context({"svg.hashsalt": "campaign", "svg.fonttype": "path"}):  # the same bytes every time
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    content = base64.b64encode(stream.getvalue()).decode("ascii")
    text = html.escape(caption)
    image = f'<img alt="{text}" src="data:image/svg+xml;base64,{content}">'
    return f"<figure>{image}<figcaption>{text}</figcaption></figure>"


def heading(name: str) -> str:
    """Words and unit of a column's name.

    Parameters
    ----------
    name
        As `um_per_1000_km` or `crack_depth_mm`.
    """
    for suffix, unit in UNITS.items():
        if name.endswith(suffix):
            return name.removesuffix(suffix).replace("_", " ") + unit
    return name.replace("_", " ")


def cell_text(name: str, value: object) -> str:
    """A value as a table shows it: words as they are, numbers as `number_text`.

    Parameters
    ----------
    name
        Of the column.
    value
        Text, truth, number, or None where it is missing.
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        return number_text(name, value)
    return _word(value)


def number_text(name: str, value: float | int | None) -> str:
    """A number as a table shows it: digits by its unit, a dash where it is missing.

    Parameters
    ----------
    name
        Of the column.
    value
        None or NaN where it is missing.
    """
    if value is None or _missing(value):
        return "–"
    if isinstance(value, int):
        return str(value)
    for suffix, digits in _DIGITS.items():
        if name.endswith(suffix):
            return f"{round(value, digits) + 0.0:.{digits}f}"
    if "miner" in name:
        return f"{value:.4f}"
    return f"{value:.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"


def _is_text(kind: pyarrow.DataType) -> bool:
    return bool(
        pyarrow.types.is_string(kind) or pyarrow.types.is_boolean(kind) or pyarrow.types.is_null(kind)
    )


def _word(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "–" if value is None else str(value)


def _breakable(text: str) -> str:
    """Text that may also break after the dots and underscores of a name."""
    return re.sub(r"(?<=[a-z\])])([._])(?=[a-z])", r"\1<wbr>", html.escape(text))


def _missing(value: float | None) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _class(text: bool) -> str:
    return ' class="text"' if text else ""
