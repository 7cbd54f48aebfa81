"""Place of a vehicle on its track at the beginning of a run: given, or as far back as possible."""

from vehicles.description import Vehicle

START_MARGIN = 1.0  # m of straight track behind the rear coupler head at the start


def start_middle(vehicle: Vehicle, place: float | None = None) -> float:
    """Arc length of the vehicle's middle at the start [m].

    Parameters
    ----------
    vehicle : its coupler heads are read
    place : of the middle, given [m]; None: the rear head stands just after s = 0

    Raises
    ------
    ValueError
        At the given place the rear head would stand before the track.
    """
    rear = min(point[0] for point in vehicle.coupler.points)
    if place is None:
        return START_MARGIN - rear
    if place + rear < 0.0:
        raise ValueError(
            f"start_m = {place:g} m: the rear end of vehicle {vehicle.name} would stand before the track; "
            f"allowed from {-rear:g} m"
        )
    return place


def start_front(vehicle: Vehicle, place: float | None = None) -> float:
    """Arc length of the vehicle's front head at the start [m]. Errors as `start_middle`.

    Parameters
    ----------
    vehicle, place : as for `start_middle`
    """
    return start_middle(vehicle, place) + max(point[0] for point in vehicle.coupler.points)
