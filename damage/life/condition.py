"""Condition of a group of wheels: profile, radius, cracks and distances, a value that a life goes on from.

A group is one wheel, or wheels that wear alike (`damage.evolution.profile_wear.TOGETHER`). Its cracks are
followed by one layer an index (``"global"``, ``"local"``: `WheelSurface.global_crack_damage` and
`WheelSurface.crack_damage`), on bins that stay the same over the life (`on_grid`). Damage of other kinds (a
sum by another life relation, below the surface, by ratchetting) rides along as a layer of another name.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from damage.evolution.history import WearStep
from damage.evolution.measures import ConicityTrack, WheelMeasures, measure
from damage.rcf.wear_and_cracks import CrackLayer
from damage.surface.lateral_grid import LateralGrid, ProfileArc
from damage.surface.stored import Arrays, BrokenFile, pack, unpack
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.log.parts import write_bytes

INDICES = ("global", "local")
_LAYER = ("damage", "damage_without_wear", "worn")
_NO_NUMBERS = "profile", "measures", "next_rate"
_NUMBERS = tuple(field.name for field in fields(WearStep) if field.name not in _NO_NUMBERS)


@dataclass(frozen=True, eq=False)
class WheelCondition:
    """A group of wheels at a distance.

    Attributes
    ----------
    group
        Its name.
    step
        Profile, radius and measures; its distance is that since the wheel was new.
    cracks
        Cracks by index since the last turning, all on one grid; the damage without wear and the worn depth
        count from there too.
    turned_at
        Distance since new of the last turning [m]; 0 without one.
    turnings
        Number of turnings.

    Raises
    ------
    ValueError
        No layer of cracks, layers on different grids, or distances and numbers below zero or out of order.
    """

    group: str
    step: WearStep
    cracks: Mapping[str, CrackLayer]
    turned_at: float = 0.0
    turnings: int = 0

    def __post_init__(self) -> None:
        if not self.cracks:
            raise ValueError(f"wheels {self.group!r} need a layer of cracks at least")
        object.__setattr__(self, "cracks", MappingProxyType(dict(sorted(self.cracks.items()))))
        if any(layer.grid != self.grid for layer in self.cracks.values()):
            raise ValueError(f"the cracks of wheels {self.group!r} lie on different grids")
        if not 0.0 <= self.turned_at <= self.step.distance < math.inf:
            raise ValueError(
                f"wheels {self.group!r} after {self.step.distance} m, turned at {self.turned_at} m: allowed "
                "is 0 <= turned_at <= distance"
            )
        if self.turnings < 0:
            raise ValueError(f"turnings = {self.turnings} of wheels {self.group!r} must be >= 0")

    @classmethod
    def new(
        cls,
        group: str,
        wheel: Profile,
        radius: float,
        failure_depth: float,
        grid: LateralGrid | None = None,
        indices: tuple[str, ...] = INDICES,
        track: ConicityTrack | None = None,
    ) -> "WheelCondition":
        """New wheels.

        Parameters
        ----------
        group
            Name of the group.
        wheel, radius
            The profile, and the radius at its running circle [m].
        failure_depth
            Depth of a crack at failure [m]: ``limit("cracks", "failure_depth")`` is assumed.
        grid
            Bins of the cracks; None takes bins of 1 mm over the lateral coordinate.
        indices
            Names of the layers of cracks.
        track
            For the equivalent conicity; None takes the default.
        """
        layer = CrackLayer.new(LateralGrid() if grid is None else grid, failure_depth)
        step = WearStep(0.0, wheel, radius, 0.0, measure(wheel, radius, track or ConicityTrack()))
        return cls(group, step, dict.fromkeys(indices, layer))

    @property
    def grid(self) -> LateralGrid:
        """Bins of the cracks."""
        return next(iter(self.cracks.values())).grid

    @property
    def since_turning(self) -> float:
        """Distance since the last turning, or since new [m]."""
        return self.step.distance - self.turned_at

    def after(self, step: WearStep, damage: Mapping[str, FloatArray], worn: FloatArray) -> "WheelCondition":
        """The wheels after a step of wear.

        Parameters
        ----------
        step
            The wheel after it.
        damage
            (B,) Miner's sum of the step by index, as without wear [-].
        worn
            (B,) wear depth of the step, normal to the surface [m].

        Raises
        ------
        ValueError
            The step ends before it begins, indices are not those of the cracks, or arrays do not fit.
        """
        if not step.distance >= self.step.distance:
            raise ValueError(
                f"a step of wheels {self.group!r} from {self.step.distance} m ends at {step.distance} m"
            )
        if set(damage) != set(self.cracks):
            raise ValueError(
                f"damage by {sorted(damage)}; wheels {self.group!r} have cracks by {sorted(self.cracks)}"
            )
        cracks = {name: layer.after(damage[name], worn) for name, layer in self.cracks.items()}
        return replace(self, step=step, cracks=cracks)

    def to_bytes(self) -> bytes:
        """Content of a file: equal for equal values."""
        header: dict[str, Any] = {
            "group": self.group,
            "turnings": self.turnings,
            "profile": self.step.profile.name,
            "cracks": sorted(self.cracks),
            "grid": {"start": self.grid.start, "step": self.grid.step, "count": self.grid.count},
        }
        numbers = {f"step_{name}": getattr(self.step, name) for name in _NUMBERS}
        numbers |= {f"measure_{name}": value for name, value in asdict(self.step.measures).items()}
        numbers["turned_at"] = self.turned_at
        arrays: Arrays = {name: np.array([value], dtype=np.float64) for name, value in numbers.items()}
        arrays |= {"y": self.step.profile.y, "z": self.step.profile.z}
        if self.step.next_rate is not None:
            arrays["next_rate"] = self.step.next_rate
        if (arc := self.grid.profile_arc) is not None:
            arrays |= {"profile_y": arc.y, "profile_arc": arc.arc}
        for index, layer in self.cracks.items():
            arrays[f"failure_depth_{index}"] = np.array([layer.failure_depth])
            arrays |= {f"{name}_{index}": getattr(layer, name) for name in _LAYER}
        return pack(header, arrays)

    @classmethod
    def from_bytes(cls, content: bytes, source: str) -> "WheelCondition":
        """The condition of the content of a file.

        Parameters
        ----------
        content
            As `to_bytes` gives it.
        source
            Name of the file, for messages.

        Raises
        ------
        BrokenFile
            It is something else, or was changed.
        """
        header, arrays = unpack(content, source)
        try:
            arc = ProfileArc(arrays["profile_y"], arrays["profile_arc"]) if "profile_y" in arrays else None
            grid = LateralGrid(**header["grid"], profile_arc=arc)
            step = WearStep(
                profile=Profile(header["profile"], "wheel", arrays["y"], arrays["z"]),
                measures=WheelMeasures(
                    **{name: arrays[f"measure_{name}"].item() for name in WheelMeasures.__annotations__}
                ),
                next_rate=arrays.get("next_rate"),
                **{name: arrays[f"step_{name}"].item() for name in _NUMBERS},
            )
            cracks = {
                index: CrackLayer(
                    grid,
                    arrays[f"failure_depth_{index}"].item(),
                    **{name: arrays[f"{name}_{index}"] for name in _LAYER},
                )
                for index in header["cracks"]
            }
            turned_at = arrays["turned_at"].item()
            return cls(str(header["group"]), step, cracks, turned_at, int(header["turnings"]))
        except (KeyError, TypeError, ValueError) as error:
            raise BrokenFile(f"{source}: holds no condition of wheels: {error}") from None

    def save(self, path: Path | str) -> None:
        """Write it into a file: afterwards it is complete, or was not touched.

        Raises
        ------
        OSError
            It cannot be written.
        """
        write_bytes(Path(path), self.to_bytes())

    @classmethod
    def load(cls, path: Path | str) -> "WheelCondition":
        """Read it from a file.

        Raises
        ------
        FileNotFoundError
            There is none.
        BrokenFile
            It is not what was written.
        """
        return cls.from_bytes(Path(path).read_bytes(), str(path))


def on_grid(values: FloatArray, grid: LateralGrid, other: LateralGrid) -> FloatArray:
    """(B',) values per bin (damage, depth) at the bins of another grid, by their lateral coordinate.

    Parameters
    ----------
    values
        (B,) on `grid`, the same over a bin.
    grid, other
        Of the values, and of the result.
    """
    return np.interp(other.lateral, grid.lateral, values, left=0.0, right=0.0)


def between(before: WheelCondition, after: WheelCondition, distance: float) -> WheelCondition:
    """The condition at a distance within a step, all of it in proportion.

    Parameters
    ----------
    before, after
        A step's ends, without a turning in it.
    distance
        Since new [m], between theirs.

    Raises
    ------
    ValueError
        Another group, a turning between, profiles of different points, or a distance outside.
    """
    one, two = before.step, after.step
    if before.group != after.group or before.turnings != after.turnings:
        raise ValueError(
            f"no step lies between {before.group!r} after {before.turnings} turnings and {after.group!r} "
            f"after {after.turnings}"
        )
    if not one.distance <= distance <= two.distance:
        raise ValueError(f"distance = {distance} m must lie within {one.distance} .. {two.distance} m")
    if one.profile.y.size != two.profile.y.size:
        raise ValueError(f"the profiles of a step have {one.profile.y.size} and {two.profile.y.size} points")
    share = (distance - one.distance) / (two.distance - one.distance) if two.distance > one.distance else 0.0

    def mixed(a: Any, b: Any) -> Any:
        return a + share * (b - a)

    profile = Profile(
        one.profile.name, "wheel", mixed(one.profile.y, two.profile.y), mixed(one.profile.z, two.profile.z)
    )
    first, last = asdict(one.measures), asdict(two.measures)
    measures = WheelMeasures(**{name: mixed(first[name], last[name]) for name in first})
    step = replace(
        two,
        distance=distance,
        profile=profile,
        radius=mixed(one.radius, two.radius),
        depth=share * two.depth,
        measures=measures,
    )
    cracks = {
        index: replace(
            layer,
            **{name: mixed(getattr(layer, name), getattr(after.cracks[index], name)) for name in _LAYER},
        )
        for index, layer in before.cracks.items()
    }
    return replace(before, step=step, cracks=cracks)
