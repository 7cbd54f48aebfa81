"""The text of a new campaign's file: a load collective, and tables for wheels, damage, limits and steps."""

from importlib.resources import files

from damage.life.limits import limited_vehicles
from hh_exudyn.campaign.collective.template import template_text
from hh_exudyn.text_files import parsed_toml

_LIMITS = """
# Limits of a wheel in service (damage/data/limits.toml), and the profiles that it may be turned to. cracks:
# index of the cracks that decide, "global" (of the patch) or "local". Without this table no wheel is turned.
[limits]
of = "{vehicle}"
targets = ["{wheel}"]
cracks = "global"
"""


def campaign_text(line: str, vehicle_name: str) -> str:
    """A file for `hh_exudyn.campaign.life.plan.read_campaign`.

    Parameters
    ----------
    line, vehicle_name
        As `hh_exudyn.campaign.collective.template.template_text`.

    Raises
    ------
    ValueError
        An unknown line or vehicle (lists the known ones).
    """
    text = template_text(line, vehicle_name)
    limited = [name for name in limited_vehicles() if vehicle_name.startswith(name)]
    wheel = parsed_toml(text, "template")["case"]["wheel_profile"]
    limits = "".join(_LIMITS.format(vehicle=name, wheel=wheel) for name in limited[:1])
    own = files("hh_exudyn.campaign.life").joinpath("data/wheels.toml").read_text(encoding="utf-8")
    return text.rstrip("\n") + "\n" + own + limits
