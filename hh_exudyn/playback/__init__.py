"""Rerun recordings of a run or a mode, and pictures of them taken without a screen.

===========  ========================================================================================
`run`        a run: `record` writes its recording, `send` streams it to a viewer that listens
`mode`       a mode of a vehicle: its bodies swing about their places on straight track
`recording`  a recording file, renamed into place when it is complete
`layout`     the blueprint: how the viewer arranges a recording
`send`       the entities of a recording, one function each; scales of forces and patches
`wheels`     the contact log by wheel: plotted quantities, contact frames
`couplings`  forces and displacements of logged couplings over time
`frames`     poses relative to frames that single precision can hold
`shapes`     vehicle and track as meshes
`viewer`     shows a recording in a window
`picture`    takes a picture of a recording without a screen
===========  ========================================================================================
"""
