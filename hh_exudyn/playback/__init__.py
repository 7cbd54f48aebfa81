"""Rerun recordings of a run, and pictures of them taken without a screen.

run          the way in: `record(run, path)` writes a recording, `send` streams one
viewer       `open_viewer(recording)` shows a recording to a person
picture      `take(recording, png, time)` draws a picture without a screen
layout       how the viewer arranges a recording
send         what is sent, entity by entity
wheels       the contact log by wheel: plotted quantities, contact frames
frames       poses relative to frames that single precision can hold
dimensions, shapes, hopper, track_shapes, meshes
             the wagon and the track as meshes
"""
