"""Vehicles on their track against closed forms and numbers from outside, as a table.

Rest: weights. Small motions: Klingel's wave, closed forms of critical speeds, published and own equations of
reference vehicles. The demo's curve: cant deficiency, weight, energy.
"""

import math
import tempfile
from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from hh_exudyn.arrays import ComplexArray
from hh_exudyn.case import Case
from hh_exudyn.case.vehicle import described
from hh_exudyn.contact.comparison import Comparison, outside_rows
from hh_exudyn.contact.functions import contact_functions
from hh_exudyn.contact.profile import gauge_point, rail_profile, read_wheel_profile
from hh_exudyn.conventions import GRAVITY, LEFT, RAIL_TOP_DISTANCE
from hh_exudyn.log.store import Run
from hh_exudyn.log.wheel_forces import wheel_forces
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import FORCE_TOLERANCE, equilibrium
from hh_exudyn.multibody.free_wheelset import CONICITY, RADIUS, conical_wheel, free_wheelset
from hh_exudyn.multibody.gz18_curve import gz18_rows
from hh_exudyn.multibody.linear.modes import LinearVehicle, critical_speed
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import parameters, vehicle
from vehicles.description import Vehicle
from vehicles.models.suspended_wheelset import stated_critical_speed
from vehicles.statics import axle_loads

_WAGONS = ("iore_wagon_loaded", "iore_wagon_empty")
_STEADY = 4.0  # s at the end of the demo: several swings of the sway that dry friction, stuck, leaves to ring
_KLINGEL_SPEED = 10.0  # m/s: 0.6 Hz, where the wheelset's mass hardly matters
_MODES_SPEED = 20.0  # m/s, of modes without creep


def vehicles_table(lm_wheel: Path | None = None) -> list[Comparison]:
    """All comparisons; some 20 s with the demo's run.

    Parameters
    ----------
    lm_wheel : file of the wheel profile LM (TB/T 449); without, GZ18 is not run
    """
    rows = [row for part in _PARTS for row in part()]
    return rows if lm_wheel is None else [*rows, *gz18_rows(lm_wheel)]


def straight_case(**changes: Any) -> Case:
    """The demo's case on rigid straight track of nominal gauge, with contact as the vehicle states it.

    Parameters
    ----------
    **changes
        To the case, as for `Case.with_changes`.
    """
    section = {"kind": "straight", "length_m": 60.0, "gauge_mm": 1435.0}
    case = _demo().with_changes(
        track={"sections": [section], "flexibility": "rigid"}, contact={"theory": "given"}
    )
    return case.with_changes(**changes)


def _demo() -> Case:
    return Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))


def rest_rows(name: str, case: Case) -> list[Comparison]:
    """Wheel loads of a vehicle at rest against its weight and the lever rule, and what force remains.

    Parameters
    ----------
    name : of the vehicle
    case : its track, straight at the start
    """
    standing = vehicle(name)
    model = assemble(standing, case.with_changes(vehicle=name))
    work = workspace(model)
    equilibrium(standing, model, work)
    loads = -work.rail_force[:, :, 1]
    half_axles = 0.5 * np.array(axle_loads(standing))[:, None]
    worst = float(np.abs(loads / half_axles - 1.0).max())
    left = float(np.abs(work.generalized_force).max()) / FORCE_TOLERANCE
    whole, weight = 1e-3 * float(loads.sum()), 1e-3 * standing.mass * GRAVITY
    return [
        Comparison(f"{name}, wheel loads [kN]", "weight", whole, weight, 1e-6),
        Comparison(f"– worst of {loads.size} wheel loads", "lever rule", worst, 0.0, 1e-3),
        Comparison(f"– force left over {FORCE_TOLERANCE:g} N", "equilibrium", left, 0.0, 1.0),
    ]


def _rest() -> list[Comparison]:
    return [row for name in _WAGONS for row in rest_rows(name, _demo())]


def _klingel() -> list[Comparison]:
    """Wavelength of a free wheelset on cones, 2 pi sqrt(r0 e / conicity), e half the contacts' distance."""
    track = {"inclination": "1:20"}  # carries the cone in the middle of the rail heads
    with tempfile.TemporaryDirectory() as folder:
        cone = conical_wheel(Path(folder) / "cone.txt")
        case = straight_case(wheel_profile=cone, track=track, contact={"theory": "fastrip"})
        linear = LinearVehicle(free_wheelset(), case)
        wheel = read_wheel_profile(cone)
    rail, gauge = rail_profile("60E1", 1.0 / 20.0), 1.435
    at = contact_functions(wheel, rail, lateral=np.zeros(1), radius=RADIUS, side=LEFT, gauge=gauge)
    half_distance = 0.5 * gauge + gauge_point(rail) - float(at.y_rail[0])
    wanted = 2.0 * math.pi * math.sqrt(float(at.rolling_radius[0]) * half_distance / CONICITY)
    swaying = [mode for mode in linear.modes(_KLINGEL_SPEED) if mode.largest(linear.names) == "wheelset_1 y"]
    found = _KLINGEL_SPEED / swaying[0].frequency
    return [Comparison("free wheelset, wavelength [m]", "Klingel 1883", found, wanted, 0.02)]


def suspended_wheelset_rows() -> list[Comparison]:
    """Critical speed and frequency of the suspended wheelset against their closed form."""
    speed, frequency = stated_critical_speed(parameters("suspended_wheelset"))
    linear = LinearVehicle(vehicle("suspended_wheelset"), straight_case())
    return _hunting("suspended wheelset", "closed form", linear, (speed, frequency), (5e-4, 5e-4))


def cooperrider_rows(exchanged: bool) -> list[Comparison]:
    """Critical speed and frequency of Cooperrider's bogie against other equations.

    Parameters
    ----------
    exchanged : whether with longitudinal and lateral creep constant exchanged, as published
    """
    bogie, name, label, source = (
        vehicle("cooperrider_bogie"), "cooperrider_bogie", "Cooperrider's bogie", "own seven equations"
    )  # fmt: skip
    if exchanged:
        stated = bogie.contact
        if stated is None:
            raise ValueError(f"vehicle {name} states no contact")
        given = replace(stated, longitudinal=stated.lateral, lateral=stated.longitudinal)
        bogie = replace(bogie, contact=given)
        name, label, source = f"{name} exchanged", "– constants exchanged", "Hassard, published"
    speed, frequency = (_outside(name, quantity)[0] for quantity in ("speed", "frequency"))
    linear = LinearVehicle(bogie, straight_case())
    return _hunting(label, source, linear, (speed, frequency), (1.5e-3, 2e-3))


def _hunting(
    label: str,
    source: str,
    linear: LinearVehicle,
    wanted: tuple[float, float],
    allowed: tuple[float, float],
) -> list[Comparison]:
    """Critical speed and its frequency, searched within a fifth of what is wanted."""
    found = critical_speed(linear, low=0.85 * wanted[0], high=1.2 * wanted[0], step=0.175 * wanted[0])
    if found is None:
        raise ArithmeticError(f"{label}: no critical speed within a fifth of {wanted[0]:.4g} m/s")
    return [
        Comparison(f"{label}, critical speed [m/s]", source, found.speed, wanted[0], allowed[0]),
        Comparison("– its frequency [Hz]", source, found.mode.frequency, wanted[1], allowed[1]),
    ]


def vertical_mode_rows(coach: Vehicle, allowed: float) -> list[Comparison]:
    """Bounce and pitch of body and frames of Manchester vehicle 1, without dampers and creep, on rigid track.

    Parameters
    ----------
    coach : the vehicle, or its like with vertical springs alone, as the reference has it
    allowed : relative deviation [-]
    """
    linear = LinearVehicle(coach, straight_case(contact={"theory": "fastrip"}))
    wanted, found = _outside("manchester_vehicle_1", "vertical"), vertical_frequencies(linear)
    if len(found) != len(wanted):
        raise ArithmeticError(f"{len(found)} vertical modes, wanted {len(wanted)}: {found}")
    return [
        Comparison(f"Manchester vehicle 1, vertical mode {k} [Hz]", "own calculation", ours, other, allowed)
        for k, (ours, other) in enumerate(zip(found, wanted, strict=True), start=1)
    ]


def vertical_frequencies(linear: LinearVehicle) -> list[float]:
    """Frequencies of the undamped modes in which sprung bodies move by bounce and pitch [Hz], ascending."""
    sprung = [i for i, name in enumerate(linear.names) if "wheelset" not in name]

    def largest(shape: ComplexArray, axes: list[int]) -> float:
        return float(np.abs(shape[sprung][:, axes]).max())

    return [
        mode.frequency
        for mode in linear.modes(_MODES_SPEED, undamped=True)
        if largest(mode.shape, [2, 4]) > max(3.0 * largest(mode.shape, [1, 3, 5]), 0.5)
    ]


def curve_rows(run: Run) -> list[Comparison]:
    """A run that ends in a steady curve: forces and power in its last seconds.

    Parameters
    ----------
    run : of a case that ends in a curve without gradient
    """
    case = Case.from_toml(run.case_text, folder=run.directory)
    track, mass = case.alignment().table, 1e-3 * described(case.vehicle).mass  # t, so that forces are in kN
    forces = wheel_forces(run)
    last = forces.time > forces.time[-1] - _STEADY
    s, time = forces.s[last], forces.time[last]
    speed = float((s[-1] - s[0]).mean() / (time[-1] - time[0]))
    roll, pull = math.asin(track.cant[-1] / RAIL_TOP_DISTANCE), speed**2 * float(track.curvature[-1])
    left = 1e-3 * float((forces.Y[last].mean(axis=0) * [1.0, -1.0]).sum())
    down = 1e-3 * float(forces.Q[last].mean(axis=0).sum())
    to_left = mass * (GRAVITY * math.sin(roll) - pull * math.cos(roll))
    to_below = mass * (GRAVITY * math.cos(roll) + pull * math.sin(roll))
    energy = {name: np.array(column) for name, column in run.read("energy").to_pydict().items()}
    steady = energy["time"] > energy["time"].max() - _STEADY
    spent, *lost = (
        1e-3 * float(energy[f"{name}_power"][steady].mean())
        for name in ("coupler", "contact", "friction", "damper")
    )
    return [
        Comparison("demo's curve, sum of Y to the left [kN]", "m (g sin - v^2/R cos)", left, to_left, 0.01),
        Comparison("– sum of Q [kN]", "m (g cos + v^2/R sin)", down, to_below, 1e-3),
        Comparison("– power of the train [kW]", "losses", spent, sum(lost), 3e-3),
    ]


def _curve() -> list[Comparison]:
    with tempfile.TemporaryDirectory() as folder:
        return curve_rows(simulate(_demo(), Path(folder) / "demo"))


def _outside(name: str, quantity: str) -> list[float]:
    """Numbers of a vehicle in ``vehicle_modes.csv``."""
    rows = outside_rows("vehicle_modes.csv")
    return [float(row["value"]) for row in rows if (row["vehicle"], row["quantity"]) == (name, quantity)]


_PARTS: tuple[Callable[[], list[Comparison]], ...] = (
    _rest,
    _klingel,
    suspended_wheelset_rows,
    lambda: cooperrider_rows(exchanged=False),
    lambda: cooperrider_rows(exchanged=True),
    lambda: vertical_mode_rows(vehicle("manchester_vehicle_1"), 6e-3),
    _curve,
)
