"""Kalker's full theory: wheel and rail as elastic half-spaces, with no assumption on pressure or slip.

===================  ================================================================================
`influence`          displacements and slip by stresses on the elements of a grid
`normal`             pressure at a given approach or load, with an upper bound if wanted
`rolling`            tractions and slip in steady rolling
`krylov`             GMRES, for the steps of `rolling`
`ellipse`            a Hertzian ellipse in rolling: the theory "halfspace" of `tangential`
`pose`               a wheel above its rail, from profiles and the pose of its wheelset
`conformal`          the overlap of wheel and rail over the arc of the wheel's profile
`wheel_rail`         pressure and forces of a wheel on a rail, at a given height or load
`conformal_slip`     rigid slip of such a contact, strip by strip
`subsurface`         stresses below the surface
`validation`         comparison with outside numbers, as a table
===================  ================================================================================

Both bodies are of one material (`material.Material`), so pressure and traction do not couple. Elements are
equal rectangles; x is the rolling direction, the second index.

Used by `tangential.api`, and by people; a run uses faster theories.
"""
