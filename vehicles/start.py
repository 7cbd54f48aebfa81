"""Place of a vehicle on its track at the beginning of a run: as far back as its rear coupler head allows."""

from vehicles.description import Vehicle

START_MARGIN = 1.0  # m of straight track behind the rear coupler head at the start


def start_middle(vehicle: Vehicle) -> float:
    """Arc length of the vehicle's middle at the start [m]: its rear head stands just after s = 0."""
    return START_MARGIN - min(point[0] for point in vehicle.coupler.points)


def start_front(vehicle: Vehicle) -> float:
    """Arc length of the vehicle's front head at the start [m]."""
    return start_middle(vehicle) + max(point[0] for point in vehicle.coupler.points)
