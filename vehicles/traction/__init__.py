"""Traction of a vehicle: drives, driver, train, steering.

==================  ================================================================================
`effort`            limits of the drives; control of speed, slip and over-slip
`curve_resistance`  of wagons in curves: Roeckl, as simulated, or none
`train`             resistance, grades, curves and inertia of the train on the rear coupler
`driver`            the driver: these laws together, from sample to sample
`steering`          active steering of wheelsets by their axle boxes
`control`           measurements and actuators of a controller
`memory`            the changing state of controllers, to store it and to put it back
==================  ================================================================================
"""
