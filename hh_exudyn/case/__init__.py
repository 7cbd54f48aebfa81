"""What a run is made from: `Case`, a frozen value that is written to and read from TOML.

=============  ======================================================================================
`case`         `Case` itself and `read_case`
`track`        the track: rails, foundation, irregularities, alignment
`contact`      contact theories, and the step of the integration
`alignment`    sections, grades, files of the alignment
`rails`        rail profiles by name or file
`friction`     the table of friction: zones, climate, treatment, sections
`vehicle`      a vehicle by name, or with some numbers changed
`traction`     drives and steering of a vehicle that drives itself
`train`        draft and brakes of a vehicle in a train
`line`         cases from the sections of a line
`numbers`      the sourced numbers that a case rests on
`fields`       how numbers with units and paths are declared
`errors`       `CaseError`: every fault in one line
=============  ======================================================================================
"""

from hh_exudyn.case.case import (
    BrakeCase,
    Case,
    CaseError,
    CentreLineCase,
    ContactCase,
    CurveCase,
    FrictionCase,
    FrictionSectionCase,
    GradeCase,
    IntegrationCase,
    RampCase,
    SteeringCase,
    StraightCase,
    SurfaceCase,
    TrackCase,
    TractionCase,
    TrainCase,
    TransitionCase,
    VehicleCase,
    read_case,
)

__all__ = [
    "BrakeCase",
    "Case",
    "CaseError",
    "CentreLineCase",
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
