"""Terms and symbols of the toolkit. `help(hh_exudyn.glossary)` shows this page.

Track and vehicle
    angle of attack         yaw of a wheelset against its rail, positive to the left [rad]
    alignment               course of the track in plan; also the lateral mean irregularity of both rails
    cant                    height of the outer over the inner rail across 1.5 m [m]
    cant deficiency         additional cant for zero lateral acceleration [m]
    conicity                change of rolling radius over lateral displacement; equivalent conicity after
                            EN 15302: that of cones with the same wavelength [-]
    cross-level             irregularity of the height difference of both rails [m]
    gauge                   least distance of the rails down to 14 mm below their tops (EN 13848-1) [m]
    gauge point             point of a rail nearest to the other one in that zone, end of the gauge
    Hunt-Crossley damping   normal force N (1 + d v) with the approach rate v [s/m]
    Klingel's wave          kinematic oscillation of a free wheelset
    level                   irregularity of the mean height of both rails [m]
    longitudinal level      the same
    nosing, hunting         lateral and yaw oscillation of wheelsets and bogies
    QN1 .. QN3              quality classes of track after UIC 518
    rail frame R            frame of one rail: the track frame turned by irregularity, ramps and deflection
    running circle          circle of a wheel 70 mm from the flange back
    three-piece bogie       bolster on springs and wedges between two side frames
    track frame T           x along the track, y to the left, z up; origin in the running plane
    warp                    lozenging of a three-piece bogie: longitudinal shift of its side frames
    wedge                   friction element between bolster and side frame, loaded by a spring

Contact
    A, B                    half the sums of the principal curvatures, along and across the track [1/m]
    a, b                    semi-axes of the patch in rolling direction and across [m]
    approach                elastic approach of wheel and rail along the normal [m]
    C11, C22, C23, C33      Kalker's creep coefficients [-]
    contact frame C         x in rolling direction, z the normal from the rail into the wheel
    coupled strips          strips fixed on a wheel that press on each other: the normal theory of a run
    creepage nu_x, nu_y     slip velocity of the wheel on the rail over the speed [-]
    creep force             tangential force of a rolling contact, here on the wheel [N]
    FASTSIM                 Kalker's simplified theory, 1982
    FaStrip                 Sichani, Enblom and Berg, 2016
    half-space              Kalker's full theory: both bodies elastic half-spaces, the reference of all others
    interpenetration        overlap of the undeformed profiles [m]
    p_max, p0               largest contact pressure [Pa]
    phi                     spin creepage: relative angular velocity about the normal over the speed [1/m]
    Q, Y                    vertical and lateral force of one wheel on its rail [N]; Y/Q their ratio
    rigid slip              slip of the undeformed bodies; slip adds that of the elastic deformation
    rolling radius          radius of the wheel at the contact [m]
    strip                   part of a patch along the rolling direction; of a wheel, a ring of its profile

Assessment
    axle sum                |Y/Q| of both wheels of a wheelset, against Weinstock's limit [-]
    dQ/Q0, unloading        missing share of the static load of a wheel [-]
    N_MV                    mean comfort of EN 12299 [-]; Wz: ride index of Sperling [-]
    Nadal's limit           Y/Q at which a flange climbs, by its angle and friction [-]
    sum Y                   lateral force of a wheelset on the track, mean over 2 m [N]
    twist                   change of the cross-level over a wheelbase, over its length [-]
    Yqst, Qqst              quasi-static Y and Q of a curve, the medians of a section [N]

Damage
    Archard, Jendel         wear depth from pressure and sliding distance; Jendel's map of its coefficient
    EI, SI                  energy index, and stress index |q| - k, of a cell of the patch [Pa]
    FI, FI_surf, FI_sub     fatigue index: utilised friction beyond the shakedown limit; surface, subsurface
    H                       hardness [Pa]
    k                       yield strength in pure shear [Pa]; also the wear coefficient of Archard's law
    high rail, low rail     outer and inner rail of a curve
    MGT                     million gross tonnes, the mass of all that passes a rail: 1e9 kg
    Miner's sum             sum of the damage of all load cycles, failure at 1
    ratchetting             growth of plastic shear with every passage, beyond the shakedown limit
    RCF                     rolling contact fatigue; RCF number: revolutions with SI > 0 at a place
    shakedown               elastic behaviour of a rolling contact after plastic flow in the first passages;
                            its limit is the largest load with it
    T gamma, wear number    energy dissipated per metre: creep forces times creepages [N]
    Sh, Sd, qR              flange height, flange thickness, flange steepness [m]
    wear ratio              wear depth over dissipated energy at a place of the profile
"""
