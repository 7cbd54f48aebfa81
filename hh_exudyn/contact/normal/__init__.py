"""Normal contact: from profiles and approach to patch, pressure and force; stresses below a patch.

====================  ===============================================================================
`registry`            a record of every theory, and the kernels that call their strips
`hertz`               ellipse, pressure, approach
`interpenetration`    the gap between the profiles across a patch, in the contact plane
`analyn`              Sichani, Enblom and Berg, 2014: Hertz strip by strip
`kik_piotrowski`      Kik and Piotrowski, 1996, with the factor of KPEC: virtual interpenetration
`equivalent_elastic`  SIMPACK's usual ellipse: area, width and depth of the virtual interpenetration
`non_elliptic`        one patch of strips: its edges, force and pressure
`neighbours`          patches near one another: the division of strips, and their interaction
`subsurface`          stresses below a line contact in full and partial slip
====================  ===============================================================================
"""
