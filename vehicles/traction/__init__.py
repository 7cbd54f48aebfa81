"""What moves a vehicle along its track and steers it: drives, train, driver.

============  =======================================================================================
`effort`      what drives can give; control of speed, slip and over-slip
`train`       resistance, grades, curves and inertia of what hangs on the rear coupler
`driver`      the driver: these laws together, from sample to sample
`steering`    active steering of wheelsets by their axle boxes
`control`     what a controller may measure and move
============  =======================================================================================
"""
