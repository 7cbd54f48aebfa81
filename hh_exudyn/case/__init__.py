"""The input of a run: `Case`, a frozen value that is written to and read from TOML.

=============  ======================================================================================
`case`         `Case` itself and `read_case`
`track`        the track: rails, foundation, irregularities, alignment
`contact`      contact theories, damping; step of the integration, output interval of the logs
`alignment`    sections, grades, files of the alignment
`irregular`    a track with its irregularities within the limits of sections
`rails`        rail profiles by name or file
`check_rail`   check rails in tight curves, or along a stretch
`friction`     the table of friction: zones, climate, treatment, sections
`vehicle`      a vehicle by name, or with some numbers changed
`traction`     drives and steering of a vehicle that drives itself
`train`        draft and brakes of a vehicle in a train
`line`         cases from the sections of a line
`wheels`       wheel profiles by side, wheelset, wheel
`files`        where the paths of a case stand, and where they start
`overrides`    a case with some inputs changed by their names
`matrix`       every combination of some values of some inputs
`differences`  inputs in which cases differ
`sealed`       a case with its vehicle and the content of all its files
`numbers`      the sourced numbers that a case rests on
`fields`       fields of numbers with units, and of paths
`errors`       `CaseError`: every fault in one line
=============  ======================================================================================
"""

from hh_exudyn.case.alignment import (
    CentreLineCase,
    CurveCase,
    GradeCase,
    RampCase,
    StraightCase,
    TransitionCase,
)
from hh_exudyn.case.case import Case, read_case
from hh_exudyn.case.check_rail import CheckRailCase
from hh_exudyn.case.contact import ContactCase, IntegrationCase
from hh_exudyn.case.errors import CaseError
from hh_exudyn.case.friction import FrictionCase, FrictionSectionCase, SurfaceCase
from hh_exudyn.case.track import TrackCase
from hh_exudyn.case.traction import SteeringCase, TractionCase
from hh_exudyn.case.train import BrakeCase, TrainCase
from hh_exudyn.case.vehicle import VehicleCase

__all__ = [
    "BrakeCase",
    "Case",
    "CaseError",
    "CentreLineCase",
    "CheckRailCase",
    "ContactCase",
    "CurveCase",
    "FrictionCase",
    "FrictionSectionCase",
    "GradeCase",
    "IntegrationCase",
    "RampCase",
    "SteeringCase",
    "StraightCase",
    "SurfaceCase",
    "TrackCase",
    "TractionCase",
    "TrainCase",
    "TransitionCase",
    "VehicleCase",
    "read_case",
]
