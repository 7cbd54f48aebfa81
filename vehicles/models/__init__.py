"""The vehicles themselves: one file each, and `RECORDS`, the records of them all.

=====================  ===============================================================================
`wagon`                LKAB's iron-ore wagon, one unit or the pair with drawbar
`three_piece_bogie`    its bogie: bolster, side frames, wheelsets and their couplings
`locomotive`           LKAB's IORE locomotive, one unit or both: driven wheelsets with nose-suspended motors
`y25_wagon`            tank wagon on Y25 bogies, laden or empty
`parts`                common functions of the builders: inertia, couplings filled from parameters
`suspended_wheelset`   reference: the smallest model that hunts, with its closed form
`cooperrider`          reference: Cooperrider's bogie
`manchester`           reference: vehicle 1 of the Manchester benchmarks
`gz18`                 reference: passenger vehicle of which SIMPACK's response is published
=====================  ===============================================================================

A new vehicle is a file here that ends in its record, its numbers in ``vehicles/data``, and a line here.
"""

from vehicles.models import (
    cooperrider,
    gz18,
    locomotive,
    manchester,
    suspended_wheelset,
    wagon,
    y25_wagon,
)
from vehicles.record import VehicleRecord

RECORDS: tuple[VehicleRecord, ...] = (
    *wagon.RECORDS,
    suspended_wheelset.RECORD,
    cooperrider.RECORD,
    manchester.RECORD,
    gz18.RECORD,
    *locomotive.RECORDS,
    *y25_wagon.RECORDS,
)
