"""Figures of the contact, as the papers show them: plain results in, matplotlib's own Figure out.

=============  ==========================================================================================
`patch`        one patch, all theories side by side: traction, stick and slip, slip velocity, forces
`conicity`     wheel and rail over the lateral displacement: rolling radius difference, conicity, positions
=============  ==========================================================================================

They need no display and compute no physics.
"""
