"""The text of a new load collective's file: commented TOML with the sources of all numbers."""

import difflib
import math
from importlib.resources import files

from hh_exudyn.contact.profiles.malmbanan import LINE_WHEELS
from track.line.line import Line, read_line
from vehicles.catalogue import vehicle, vehicle_names
from vehicles.start import start_front

_MERGED = 'merged_classes = [["350:400", "400:450"], ["600:800", "800:1000"]]\n'
_FEWER = 2  # groups than classes by merging
_RUNS = 20  # an evaluation: 4 h on two cores are some 2,400 runs, for 60 steps with two evaluations each
_TIGHT = ("<350", "350:400", "400:450")  # three in four of them lie on the descent to Narvik
_MALMBANAN = "malmbanan"  # the line of which these classes are
_FADE = 50.0  # m, of irregularities
_LOADS = ("loaded", "empty")
_SHOE_KN = {"loaded": "10.0", "empty": "4.0"}
_MASS_T = {"loaded": "120.0", "empty": "21.6"}


def template_text(line: str = _MALMBANAN, vehicle_name: str = "iore_wagon_pair") -> str:
    """A file for `hh_exudyn.campaign.collective.plan_file.read_plan`.

    Parameters
    ----------
    line : str
        A known line or the path of a line's file.
    vehicle_name : str
        A vehicle of the catalogue, or the common beginning of its loaded and its empty state.

    Raises
    ------
    ValueError
        An unknown line or vehicle (lists the known ones).
    """
    known = vehicle_names()
    of_loads = [f"{vehicle_name}_{load}" for load in _LOADS]
    two = vehicle_name not in known and all(name in known for name in of_loads)
    described = vehicle(of_loads[0] if two else vehicle_name)
    driven = bool(described.drives)
    kind = "driven" if driven else "hauled"
    speeds = read_line(line)
    texts = [_data("campaign.toml")]
    loads = _LOADS if two or driven else _LOADS[:1]
    for load in loads:
        words = {
            "RUNNING": load if two or driven else "running",
            "VEHICLE": f"{vehicle_name}_{load}" if two else vehicle_name,
            "LINE_VEHICLE": _speed_name(speeds, f"{vehicle_name}_{load}", load),
            "SHARE": "50.0" if two or driven else "100.0",
            "RETURNING": "true" if load == "empty" else "false",
            "SHOE": _SHOE_KN[load],
            "MASS": _MASS_T[load],
            **_gradients(load == "empty", line == _MALMBANAN),
        }
        texts.append(_filled(_data(f"running_{kind}.toml"), words))
    merged = _MERGED if line == _MALMBANAN else ""
    groups = len({part.name for part in speeds.classes}) - (_FEWER if merged else 0)
    wheel = LINE_WHEELS[1 if driven else 0] if line == _MALMBANAN else "S1002"
    words = {
        "NAME": f"{vehicle_name} on {line}",
        "LINE": line,
        "MERGED": merged,
        "RUNS": str(max(_RUNS, 2 * groups * len(loads))),
        "WHEEL": wheel,
        "APPROACH": _rounded_up(start_front(described) + _FADE),
        "RUN_OUT": _rounded_up(max(_FADE, start_front(described))),
    }
    return _filled("".join(texts), words)


def _data(name: str) -> str:
    return files("hh_exudyn.campaign.collective").joinpath(f"data/{name}").read_text(encoding="utf-8")


def _filled(text: str, words: dict[str, str]) -> str:
    for key, word in words.items():
        text = text.replace(f"@{key}@", word)
    return text


def _gradients(returning: bool, of_malmbanan: bool) -> dict[str, str]:
    """Shares of gradients, and of those in tight curves of the iron-ore line: what goes down comes up."""
    shares = {"up": ("20.0", "10.0"), "level": ("45.0", "15.0"), "down": ("35.0", "75.0")}
    opposite = {"up": "down", "level": "level", "down": "up"}
    found = {}
    for name in shares:
        all_curves, tight = shares[opposite[name] if returning else name]
        classes = ", ".join(f'"{curve}" = {tight}' for curve in _TIGHT)
        found[f"{name.upper()}_SHARE"] = all_curves
        found[f"{name.upper()}_CLASSES"] = f"of_class = {{ {classes} }}\n" if of_malmbanan else ""
    return found


def _rounded_up(length: float) -> str:
    """To whole 5 m, as in the file."""
    return f"{5.0 * math.ceil(length / 5.0):.1f}"


def _speed_name(line: Line, name: str, load: str) -> str:
    """The vehicle of the line's speeds that is nearest: of that load if there are such."""
    names = list(line.speed.largest)
    of_load = [other for other in names if other.endswith(load)] or names
    return next(iter(difflib.get_close_matches(name, of_load, n=1, cutoff=0.0)))
