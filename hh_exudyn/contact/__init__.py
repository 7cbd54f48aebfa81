"""A wheel on a rail: from profiles and pose to patches, pressures and creep forces. No Exudyn, no files.

==================  =================================================================================
`types`             NamedTuples that enter kernels, columns of a contact state
`material`          elastic constants
`profile`           wheel and rail profiles: standard shapes (`standard_profiles`) and readers
`profile_spline`    a profile, smoothed, as the table that kernels read
`silhouette`        the line on which a rolled and yawed wheel can touch a prismatic rail
`search`            all contact patches of a wheel on its rail, for a full pose of the wheelset
`hertz`             normal contact: ellipse, pressure, approach
`interpenetration`  the gap between the profiles across a patch, in the contact plane
`analyn`            Sichani, Enblom and Berg, 2014: Hertz strip by strip
`kik_piotrowski`    Kik and Piotrowski, 1996, with the factor of KPEC: virtual interpenetration
`non_elliptic`      one patch of strips: its edges, force and pressure
`neighbours`        patches near one another: whose strips are whose, what they press down
`kalker`            creep coefficients of the linear theory
`carter`            line contact, 1926
`linear`            Kalker's linear theory
`strip`             Haines and Ollerton, 1963, Kalker 1967: every strip a line contact
`polach`            Polach's closed formulas, 1999
`fastsim`           Kalker's simplified theory, 1982
`fastrip`           Sichani, Enblom and Berg, 2016: strip theory with FASTSIM directions
`theories`          the tangential theories by number, the kernels that call them
`tangential`        one signature for all tangential theories: `creep_force`, `traction_field`
`validation`        errors of the tangential theories against the exact solution
`patch_forces`      all forces of one patch
`wheel_rail`        pose and velocity of wheelsets and rails -> wrenches and contact states, in one kernel
`contact_state`     one patch by the names of the contact log
`wheelset`          a wheel or a wheelset at rest on its rails: the height that carries the load
`patch_shape`       strips and tractions of a logged contact state
==================  =================================================================================
"""
