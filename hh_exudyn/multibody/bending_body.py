"""A body of a vehicle that bends: Exudyn's beam elements in place of a rigid body.

The body becomes two light ones above its supports, which the beam connects; its couplings go to the nearer of
both, and its weight stands there, so that the vehicle stands as before. The beam is free at its ends,
uniform, stiff in shear and in length; its stiffness is that of the first bending frequency of a free body,

    2 pi f = (4.73004 / L)^2 sqrt(EI L / m)      (Euler and Bernoulli; Young and Felgar 1949)

which shear and the rotary inertia of the section lower by about 1 %.
"""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import exudyn
import numpy as np
from exudyn.itemInterface import NodeRigidBodyRotVecLG, ObjectBeamGeometricallyExact, SensorNode

from hh_exudyn.multibody.exudyn_system import ExudynSystem
from vehicles.couplings import Coupling, Rod
from vehicles.description import Body, Vehicle

SHARE = 0.05  # of the mass that the two light bodies keep
_FIRST = 4.730041  # of a free-free beam: cos x cosh x = 1
_SHEAR = 2e3  # shear and longitudinal stiffness over EI / L^2
_GYRATION = 0.4  # m, of the section about its lateral axis: a larger one would lower the frequency


@dataclass(frozen=True)
class BendingBody:
    """A bending body; an instance is an `extension` for the vehicle from `in_two`.

    Raises ValueError where the supports do not lie within the length, rear one first, or a number is not > 0.
    """

    body: Body  # the rigid one, of the vehicle as it is
    length: float  # [m]
    supports: tuple[float, float]  # places of rear and front support on the drawing [m]
    frequency: float  # of its first bending mode, free [Hz]
    elements: int = 8  # between the supports; one more at each end

    def __post_init__(self) -> None:
        rear, front = self.supports
        middle, half = self.body.position[0], 0.5 * self.length
        if not (self.length > 0.0 and middle - half < rear < front < middle + half):
            raise ValueError(
                f"bending body {self.body.name}: supports at {self.supports} m, allowed from rear to front "
                f"within its length, {middle - half:g} to {middle + half:g} m"
            )
        if not (self.frequency > 0.0 and self.elements > 0):
            raise ValueError(
                f"bending body {self.body.name}: frequency {self.frequency} Hz and elements {self.elements} "
                "must be > 0"
            )

    @property
    def stiffness(self) -> float:
        """EI of the beam [N m^2]."""
        return self.body.mass * self.length**3 * (2.0 * math.pi * self.frequency / _FIRST**2) ** 2

    @property
    def rigid(self) -> Body:
        """What it is without bending: the body with the pitch and yaw inertia of its uniform beam.

        A stiff bending body moves as this one does; the given body's own inertia may be another one.
        """
        about = self.length**2 / 12 + _GYRATION**2
        for support in self.supports:
            about += 0.5 * SHARE * ((support - self.body.position[0]) ** 2 - self.length**2 / 12)
        across = self.body.mass * about
        return replace(self.body, inertia=(self.body.inertia[0], across, across))

    @property
    def names(self) -> tuple[str, str]:
        """Of the two light bodies, rear one first."""
        return f"{self.body.name}_rear", f"{self.body.name}_front"

    @property
    def middle(self) -> str:
        """Name of the sensor of the beam's middle node: its global position [m]."""
        return f"{self.body.name} middle"

    @property
    def end(self) -> str:
        """Name of the sensor of the beam's rear end."""
        return f"{self.body.name} rear end"

    def in_two(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle with half the body above each support.

        Parameters
        ----------
        vehicle : with the rigid body
        """
        half = replace(
            self.body,
            mass=0.5 * self.body.mass,
            inertia=(0.5 * self.body.inertia[0], 0.5 * self.body.inertia[1], 0.5 * self.body.inertia[2]),
        )
        _, y, z = self.body.position
        halves = [
            replace(half, name=name, position=(x, y, z))
            for name, x in zip(self.names, self.supports, strict=True)
        ]
        others = [body for body in vehicle.bodies if body.name != self.body.name]
        coupler = vehicle.coupler
        heads = zip(coupler.bodies, coupler.points, strict=True)
        return replace(
            vehicle,
            bodies=(*halves, *others),
            couplings=tuple(self._held(coupling) for coupling in vehicle.couplings),
            coupler=replace(coupler, bodies=tuple(self._at(body, point[0]) for body, point in heads)),
        )

    def __call__(self, system: ExudynSystem) -> None:
        """Add the beam.

        Parameters
        ----------
        system : of the vehicle from `in_two`
        """
        nodes = dict(zip(self.supports, (system.nodes[name] for name in self.names), strict=True))
        for name in self.names:
            # half a long body has much pitch inertia, which is the beam's
            bending = 0.5 * SHARE * self.body.mass * _GYRATION**2
            system.make_light(name, SHARE, (0.5 * SHARE * self.body.inertia[0], bending, bending))
        places = self._places()
        for x in places:
            if x not in nodes:
                place = [*system.place((x, *self.body.position[1:])), 0.0, 0.0, 0.0]
                nodes[x] = system.mbs.AddNode(NodeRigidBodyRotVecLG(referenceCoordinates=place))
        section = self._section()
        for rear, front in pairwise(places):
            ends = [nodes[rear], nodes[front]]
            beam = ObjectBeamGeometricallyExact(nodeNumbers=ends, length=front - rear, sectionData=section)
            system.mbs.AddObject(beam)
        for name, x in ((self.middle, places[len(places) // 2]), (self.end, places[0])):
            kind = exudyn.OutputVariableType.Position
            sensor = SensorNode(nodeNumber=nodes[x], storeInternal=False, outputVariableType=kind)
            system.sensors[name] = system.mbs.AddSensor(sensor)

    def _places(self) -> list[float]:
        """Of the nodes, from the rear end [m]."""
        middle, half = self.body.position[0], 0.5 * self.length
        between = np.linspace(*self.supports, self.elements + 1).tolist()
        return [middle - half, self.supports[0], *between[1:-1], self.supports[1], middle + half]

    def _section(self) -> exudyn.BeamSection:
        """Mass and stiffness of the beam over its length."""
        line = (1.0 - SHARE) * self.body.mass / self.length
        about = (1.0 - SHARE) * self.body.inertia[0] / self.length
        stiff = _SHEAR * self.stiffness / self.length**2
        section = exudyn.BeamSection()
        section.massPerLength = line
        section.inertia = np.diag([about, _GYRATION**2 * line, _GYRATION**2 * line])
        section.stiffnessMatrix = np.diag(
            [stiff, stiff, stiff, self.stiffness, self.stiffness, self.stiffness]
        )
        return section

    def _at(self, body: str, x: float) -> str:
        """The light body nearer to a place, for the body itself; the name of any other."""
        if body != self.body.name:
            return body
        return self.names[int(abs(x - self.supports[1]) < abs(x - self.supports[0]))]

    def _held(self, coupling: Coupling) -> Coupling:
        """A coupling between the same places, at the light bodies."""
        ends = (coupling.point_a, coupling.point_b) if isinstance(coupling, Rod) else (coupling.point,) * 2
        return replace(
            coupling,
            body_a=self._at(coupling.body_a, ends[0][0]),
            body_b=self._at(coupling.body_b, ends[1][0]),
        )
