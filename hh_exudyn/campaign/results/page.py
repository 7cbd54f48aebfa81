"""One page for a campaign, that needs no other file: results, figures, inputs, and what was left out."""

import html

import pyarrow

from damage.figures.evolution import profiles_figure
from hh_exudyn import __version__
from hh_exudyn.campaign.results import figures, inputs, lives, shares, tables
from hh_exudyn.campaign.results.errors import errors_of, errors_table
from hh_exudyn.campaign.results.html_parts import SORTING, STYLE, figure_html, table_html
from hh_exudyn.campaign.results.recorded import Recorded

_NOW = (
    "group", "life", "distance_km", "diameter_mm", "Sh_mm", "Sh_change_mm", "Sd_mm", "Sd_change_mm", "qR_mm",
    "qR_change_mm", "hollow_mm", "equivalent_conicity", "p_max_MPa",
)  # fmt: skip
_TURNED = (
    "group", "life", "due_km", "distance_km", "since_turning_km", "cause", "measure", "cut_mm",
    "cut_for_profile_mm", "worn_diameter_mm", "diameter_mm", "end",
)  # fmt: skip


def page(recorded: Recorded) -> str:
    """The page as HTML: figures inside, tables that sort at a click, A4 in print, nothing from a network.

    Parameters
    ----------
    recorded
        The steps of a campaign.
    """
    name = html.escape(recorded.campaign.plan.collective.plan.name)
    sections = (
        ("Wheels", _wheels(recorded)),
        ("Over the distance", _over_distance(recorded)),
        ("Over the profile", _over_profile(recorded)),
        ("What the damage comes from", _shares(recorded)),
        ("Rails", _rails(recorded)),
        ("Errors", _errors(recorded)),
        ("Inputs", _inputs(recorded)),
        ("Left out, and failed", _left_out(recorded)),
        ("To repeat it", _repeat(recorded)),
        ("All steps", _steps(recorded)),
    )
    body = "\n".join(f"<h2>{title}</h2>\n{content}" for title, content in sections)
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title>\n'
        f"<style>{STYLE}</style></head>\n<body><h1>{name}</h1>\n{_head(recorded)}\n{body}\n"
        f"<script>{SORTING}</script></body></html>\n"
    )


def _head(recorded: Recorded) -> str:
    ends, goal = recorded.ends, recorded.campaign.plan.collective.plan.distance
    ran, reused = sum(end.ran for end in ends), sum(end.reused for end in ends)
    return _note(
        f"{1e-3 * recorded.distance:.0f} km of {1e-3 * goal:.0f} km in {len(ends) - 1} steps; {ran} cases "
        f"run, {reused} not run again as no wheel had moved in its contact. hh-exudyn {__version__}."
    )


def _wheels(recorded: Recorded) -> str:
    measures = tables.measures_table(recorded)
    last = [row for row in measures.to_pylist() if row["distance_km"] == 1e-3 * recorded.distance]
    parts = [
        _titled("Measures now, and change from the start", _rows(last, _NOW)),
        _titled("Wear by place of the wheel, after running-in", tables.wear_table(recorded)),
        _titled("Running-in", tables.running_in_table(recorded)),
        _titled(
            "Cracks by place: Miner's sum by each index, and depth of the deepest crack",
            tables.cracks_table(recorded),
        ),
    ]
    turned, forecast = lives.turnings_table(recorded), lives.forecast_table(recorded)
    shown = _note("None so far.") if turned is None else table_html(turned.select(list(_TURNED)))
    parts.append("<h3>Turnings</h3>" + shown)
    if forecast is not None:
        note = "An extrapolation by the rates of the last evaluation; worn profiles have other rates."
        parts.append(_titled("When the wheels are due next", forecast) + _note(note))
    return "".join(parts)


def _over_distance(recorded: Recorded) -> str:
    caption = (
        "Measures of the wheels, largest contact pressure, and largest Miner's sums on the tread; limits "
    )
    return figure_html(figures.over_distance_figure(recorded), caption + "dashed where the wheels are near.")


def _over_profile(recorded: Recorded) -> str:
    caption = (
        "Wear and cracks of the present life. Dotted: cracks without what wore off. Bands of the tread: "
        "y = -50 to -20 mm and -20 to 0 mm."
    )
    parts = [figure_html(figures.over_profile_figure(recorded), caption)]
    for group in recorded.groups:
        caption = f"{group}: profiles over the distance, and the depth worn off."
        parts.append(figure_html(profiles_figure(recorded.history(group)), caption))
    return "".join(parts)


def _shares(recorded: Recorded) -> str:
    table = shares.shares_table(recorded)
    parts = [
        _note(
            "Shares at the bin of each place where the wheels wear most, or have most crack damage, by the "
            "rates of the last evaluation."
        )
    ]
    for group in recorded.groups:
        caption = f"{group}: shares of the distance, of the wear and of the crack damage."
        parts.append(figure_html(figures.shares_figure(table, group), caption))
    return "".join(parts) + _titled("All shares", table)


def _rails(recorded: Recorded) -> str:
    table = tables.rails_table(recorded)
    if table is None:
        return _note("Not summed.")
    note = "By class, per million gross tonnes (MGT), with the wheels of the last evaluation."
    return _note(note) + table_html(table)


def _errors(recorded: Recorded) -> str:
    table, content = errors_table(recorded), errors_of(recorded)
    if table is None or content is None:
        return _note("Not evaluated: hh-exudyn campaign error states them.")
    where = f"At {content['distance_km']:.0f} km, with {content['runs']} runs."
    picture = figure_html(
        figures.errors_figure(recorded, content), "Rates with half the width of their 95 % interval."
    )
    return _note(where) + _note(content["words"]) + picture + table_html(table)


def _inputs(recorded: Recorded) -> str:
    campaign = recorded.campaign
    named = "".join(
        f"<dt>{html.escape(name)}</dt><dd>{html.escape(text)}</dd>"
        for name, text in inputs.settings(campaign)
    )
    limits = inputs.limits_table(campaign)
    return "".join(
        (
            f"<dl>{named}</dl>",
            _titled("Assumed numbers, with their ranges", inputs.assumed_table(campaign)),
            "" if limits is None else _titled("Limits of the wheels", limits),
            _titled("Published and derived numbers", inputs.known_table(campaign)),
        )
    )


def _left_out(recorded: Recorded) -> str:
    left = "".join(f"<li>{html.escape(text)}</li>" for text in recorded.campaign.plan.collective.left_out())
    failed = tables.failures_table(recorded)
    shown = table_html(failed) if failed.num_rows else _note("None.")
    return f"<p>The load collective leaves out:</p><ul>{left}</ul><h3>Failed cases</h3>{shown}"


def _repeat(recorded: Recorded) -> str:
    command = f"hh-exudyn campaign run campaign.toml --out DIR --distance-km {1e-3 * recorded.distance:g}"
    return (
        f"<pre>{html.escape(command)}</pre><p>with hh-exudyn {__version__} and this campaign.toml:</p>"
        f"<pre>{html.escape(recorded.campaign.text)}</pre>"
    )


def _steps(recorded: Recorded) -> str:
    return _titled("What every step took", tables.steps_table(recorded)) + _titled(
        "Measures after every step", tables.measures_table(recorded).select(list(_NOW))
    )


def _titled(title: str, table: pyarrow.Table) -> str:
    return f"<h3>{html.escape(title)}</h3>{table_html(table)}"


def _rows(rows: list[dict[str, object]], columns: tuple[str, ...]) -> pyarrow.Table:
    return pyarrow.Table.from_pylist([{name: row[name] for name in columns} for row in rows])


def _note(text: str) -> str:
    return "".join(f'<p class="note">{html.escape(line)}</p>' for line in text.splitlines())
