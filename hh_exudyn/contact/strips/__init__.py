"""Coupled strips: normal contact and creep forces of one wheel from tread to flange, in one mechanism.

Strips are fixed on the wheel; each has its own normal, overlap with the rail, rolling radius and slip. They
press on each other as strips on two half-spaces do: one linear complementarity problem per wheel (after the
idea of semi-Hertzian strips, J.B. Ayasse and H. Chollet, Vehicle System Dynamics 43 (2005) 161-172, with the
influence of the half-space). A conformal contact in the flange root is one run of strips, tread and flange
are two, and where one passes into the other no force jumps.

In the order of an evaluation.

==================  =================================================================================
`table`             the strips of a wheel profile; the quantities of a strip by name
`overlap`           strips inside the rail, their overlap along the normal
`influence`         displacement of a strip under the load of another
`loads`             the loads: the complementarity problem
`edges`             edges of contact within a strip
`equations`         the equations of both in memory, and their order
`elimination`       a small linear system, or a part of it
`shape`             half lengths and pressures from the loads
`creep`             creep forces and tractions by FaStrip, each strip with its own slip
`pressure`          pressures by a second solution, for logs and damage
==================  =================================================================================

Called from outside a run.

==================  =================================================================================
`normal`            overlaps, loads and pressures of one pose
`rebuilt`           the strips behind a row of the contact log
`validation`        comparison with Hertz and CONTACT
==================  =================================================================================

Arguments that most kernels have; they trust them.

==================  =================================================================================
`pair`              profiles and pose of the wheel and its rail
`strips`            those of the wheel's profile, in contact or not
`count`             number of strips with overlap
`modulus`           G/(1 - nu) of both bodies [Pa]
`state`             (ROWS, CAPACITY) work space: a column for each strip with overlap, rows by `table.Row`
==================  =================================================================================
"""
