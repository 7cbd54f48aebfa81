"""The front of `hh_exudyn.contact.normal.hertz`: the ellipse of Hertz."""

from hh_exudyn.contact.normal.hertz import HertzPatch, hertz_patch

__all__ = ["HertzPatch", "hertz_patch"]
