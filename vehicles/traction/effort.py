"""Traction and braking of a locomotive: limits of its drives, control of speed, slip and over-slip.

Plain laws of numbers and arrays, stepped at the sample time of a controller; independent of the solver. An
effort is a force at the wheel treads, positive forwards; a torque is one of a wheelset about its axle.
"""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray


@dataclass(frozen=True)
class TractionEquipment:
    """Limits of the drives of one unit: constant effort up to a speed, constant power above it."""

    starting_effort: float  # [N]
    power: float  # at the treads, in traction [W]
    braking_effort: float  # of the electro-dynamic brake [N]
    braking_power: float  # [W]
    gear_ratio: float  # turns of the motor per turn of the wheelset
    rotor_inertia: float  # of one motor about its own axis [kg m^2]

    def __post_init__(self) -> None:
        for name in ("starting_effort", "power", "braking_effort", "braking_power", "gear_ratio"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"traction equipment: {name} {getattr(self, name)} must be > 0")
        if not self.rotor_inertia >= 0.0:
            raise ValueError(f"traction equipment: rotor_inertia {self.rotor_inertia} kg m^2 must be >= 0")

    @property
    def reflected_inertia(self) -> float:
        """Inertia that the rotor of one motor adds to the spin of its wheelset [kg m^2]."""
        return self.gear_ratio**2 * self.rotor_inertia

    def largest_effort(self, speed: float) -> float:
        """Largest tractive effort of the unit at a speed [m/s], in newton."""
        return _characteristic(self.starting_effort, self.power, speed)

    def largest_brake(self, speed: float) -> float:
        """Largest electro-dynamic braking effort of the unit at a speed [m/s], in newton, positive."""
        return _characteristic(self.braking_effort, self.braking_power, speed)


def _characteristic(effort: float, power: float, speed: float) -> float:
    return min(effort, power / max(abs(speed), power / effort))


@dataclass(frozen=True)
class SpeedControlGains:
    """Poles of the closed loop of speed: a mass under a PID control of it."""

    frequency: float = 0.3  # undamped angular frequency [rad/s]
    damping_ratio: float = 1.0
    derivative: float = 0.0  # share of the mass that the control adds to the inertia [-]
    rate: float = 50e3  # largest change of effort for each unit [N/s]


class SpeedControl:
    """PID control of the speed of a mass: the effort of all units together, within its bounds.

    M v' = F - D and F = P e + I int e dt - D v' give poles of frequency w and damping z where P = 2 z w M,
    I = w^2 M (with M the mass and the inertia added by the derivative). The integral stops where the effort
    meets a bound, so that it does not wind up. `effort` starts as the effort that balances the train.
    """

    def __init__(self, set_speed: float, mass: float, effort: float, gains: SpeedControlGains) -> None:
        felt = mass * (1.0 + gains.derivative)
        self.set_speed = set_speed
        self._proportional = 2.0 * gains.damping_ratio * gains.frequency * felt
        self._integral = gains.frequency**2 * felt
        self._derivative = gains.derivative * mass
        self._held = effort
        self._effort = effort
        self._speed: float | None = None

    def step(self, speed: float, least: float, most: float, rate: float, interval: float) -> float:
        """Effort [N] for the next interval [s], between `least` and `most` [N], at `rate` [N/s] at most.

        Parameters
        ----------
        speed : of the vehicle [m/s]
        least, most : bounds of the effort [N]
        rate : largest rate of change of the effort [N/s]
        interval : until the next sample [s]
        """
        change = 0.0 if self._speed is None else (speed - self._speed) / interval
        self._speed = speed
        error = self.set_speed - speed
        held = self._held + self._integral * error * interval
        wanted = self._proportional * error + held - self._derivative * change
        low = max(least, self._effort - rate * interval)
        high = min(most, self._effort + rate * interval)
        low = min(low, most)  # a bound that moves faster than the rate holds all the same
        high = max(high, least)
        self._effort = min(max(wanted, low), high)
        if self._effort == wanted or (wanted - self._effort) * error < 0.0:
            self._held = held
        return self._effort


@dataclass(frozen=True)
class SlipLimits:
    """Thresholds of slip detection, and the course of the torque after a detected slip."""

    creepage: float = 0.02  # of the speed
    least_slip: float = 0.15  # m/s, below it a slip counts as measuring error
    acceleration: float = 1.5  # of the wheel's tread beyond that of the vehicle [m/s^2]
    reduction: float = 8.0  # of the torque demanded, per second
    hold: float = 0.5  # s after a slip before the torque comes back
    recovery: float = 0.15  # per second


class SlipControl:
    """Share of the demanded torque for each axle, from the speeds of its wheels.

    Detected from the slip, and from the acceleration of the tread before the slip has grown; in braking with
    the signs reversed (sliding). The torque of a wheelset that slips falls at once, is held, and comes back
    slowly: a search for the available adhesion.
    """

    def __init__(self, axles: int, limits: SlipLimits) -> None:
        self._limits = limits
        self._share = np.ones(axles)
        self._wait = np.zeros(axles)
        self._slip: FloatArray | None = None

    def step(
        self, wheel_speeds: FloatArray, speeds: FloatArray, effort: float, interval: float
    ) -> FloatArray:
        """Shares 0..1 of the torque for the next interval [s].

        Parameters
        ----------
        wheel_speeds, speeds : (axles,) arrays
            Spin times rolling radius, and the true forward speed of each wheelset [m/s].
        effort : float
            Demanded effort, positive in traction, negative in braking.
        """
        limits = self._limits
        slip = (wheel_speeds - speeds) * (1.0 if effort >= 0.0 else -1.0)
        growth = np.zeros_like(slip) if self._slip is None else (slip - self._slip) / interval
        self._slip = slip
        threshold = np.maximum(limits.creepage * np.abs(speeds), limits.least_slip)
        slipping = (slip > threshold) & (growth > -limits.acceleration)
        slipping |= (growth > limits.acceleration) & (slip > 0.3 * threshold)
        self._wait = np.where(slipping, limits.hold, np.maximum(self._wait - interval, 0.0))
        change = np.where(slipping, -limits.reduction, np.where(self._wait > 0.0, 0.0, limits.recovery))
        self._share = np.minimum(np.maximum(self._share + change * interval, 0.0), 1.0)
        return self._share


class OverSlip:
    """Extra torque for a wanted slip dv of each driven wheelset, to clean rails or to wear off cracks.

    Hossein-Nia (2018), chapter 5: over-slip by "an extra torque to the driven loco wheels". A PI control of
    the slip velocity.

    Parameters
    ----------
    creepage : wanted, dv over the speed [-]
    radius : of the wheels [m]
    inertia : of a wheelset's spin with its rotor [kg m^2], the only resistance of a wheel under saturated
        creep force
    torques : (axles,) at the start [N m]
    """

    TIME_CONSTANT = 0.10  # s, of the slip under saturated friction
    RESET_TIME = 0.25  # s, of the integral

    def __init__(self, creepage: float, radius: float, inertia: float, torques: FloatArray) -> None:
        self._creepage = creepage
        self._gain = inertia / (radius * self.TIME_CONSTANT)
        self._held = torques.copy()

    def step(
        self, wheel_speeds: FloatArray, speeds: FloatArray, largest: float, interval: float
    ) -> FloatArray:
        """Torques [N m] for the next interval [s], each within `largest` [N m] of zero.

        Parameters
        ----------
        wheel_speeds, speeds : (axles,) spin times rolling radius, and true forward speed [m/s]
        largest : largest torque of either sign [N m]
        interval : until the next sample [s]
        """
        error = (1.0 + self._creepage) * speeds - wheel_speeds
        self._held = np.clip(self._held + self._gain / self.RESET_TIME * error * interval, -largest, largest)
        return np.clip(self._held + self._gain * error, -largest, largest)
