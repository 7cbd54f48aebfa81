"""A wheel on a rail: from profiles and pose to patches, pressures and creep forces. No Exudyn, no plots.

Read in this order; each file is one idea or one published method.

Both bodies
    `types`             NamedTuples that enter kernels, columns of a contact state
    `material`          elastic constants

Profiles
    `profile`           the front: standard shapes, readers; `profile_line` is the `Profile` itself
    `profile_reader`    files of any format, found by content (`profile_formats`, `profile_axes`), cleaned
                        (`profile_cleaning`) and smoothed by a stated rule (`profile_smoothing`)
    `profile_writer`    two columns or MiniProf-like text
    `profile_measures`  flange height, thickness, qR and angle; rail head wear
    `standard_profiles` S1002 and rail heads from their arcs
    `line_profiles`     stand-ins for the profiles of the Malmbanan line, all assumed
    `profile_spline`    a profile as the table that kernels read
    `rail_tables`       the rail of one side along the track, changing from profile to profile

Contact geometry, no force
    `silhouette`        the line on which a rolled and yawed wheel can touch a prismatic rail
    `search`            all contact patches of a wheel on its rail, for a full pose of the wheelset
    `functions`         the front of rolling radius difference and equivalent conicity (`contact_geometry`,
                        `conicity`, `rigid_contact`), and what they are worth on a track: `steering`

Normal contact
    `hertz`             ellipse, pressure, approach
    `interpenetration`  the gap between the profiles across a patch, in the contact plane
    `analyn`            Sichani, Enblom and Berg, 2014: Hertz strip by strip
    `kik_piotrowski`    Kik and Piotrowski, 1996, with the factor of KPEC: virtual interpenetration
    `non_elliptic`      one patch of strips: its edges, force and pressure
    `neighbours`        patches near one another: whose strips are whose, what they press down
    `subsurface`        stresses below a line contact in full and partial slip

Tangential contact
    `kalker`            creep coefficients of the linear theory
    `carter`            line contact, 1926
    `linear`            Kalker's linear theory
    `strip`             Haines and Ollerton, 1963, Kalker 1967: every strip a line contact
    `polach`            Polach's closed formulas, 1999
    `fastsim`           Kalker's simplified theory, 1982
    `fastrip`           Sichani, Enblom and Berg, 2016: strip theory with FASTSIM directions
    `theories`          the theories by number, the kernels that call them
    `given`             creep coefficients and conicity as a reference model states them
    `tangential`        one signature for all: `creep_force`, `traction_field`
    `validation`        their errors against the exact solution

All together
    `friction`          the coefficient of one patch by place, zone of the wheel and slip speed
    `patch_forces`      all forces of one patch
    `wheel_rail`        pose and velocity of wheelsets and rails -> wrenches and contact states, in one kernel
    `wheelset`          a wheel or a wheelset at rest on its rails: the height that carries the load
    `contact_state`     one patch by the names of the contact log
    `patch_shape`       strips and tractions of a logged contact state
"""
