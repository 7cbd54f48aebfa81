"""The life of a wheel: limits, turnings and the diameter that they use up.

    limits, places = WheelLimits.of("iore_locomotive"), WheelPlaces.of(profile)
    wheels = WheelCondition.new("leading outer", profile, 0.625, limit("cracks", "failure_depth"))
    after = wheels.after(step, {"global": ..., "local": ...}, worn)  # as often as the wheel is evaluated
    reached = crossings(wheels, after, limits, places)               # none: it runs on
    at = between(wheels, after, reached[0].distance)
    turned = turn(at, limits, TurningRule([profile]), (reached[0].reason,))
    turned.condition                                                 # the next life; None: the end
    write_life(folder, [turned, ...])

============================  ==========================================================================
`damage.life.limits`          limits of wheels in service, from ``damage/data/limits.toml``
`damage.life.places`          tread, root and flange by place, bands of RCF
`damage.life.condition`       `WheelCondition`: profile, cracks and distances, kept as bytes
`damage.life.decision`        the limits that are reached, and where within a step
`damage.life.turning`         the cut to a profile and below the cracks, the end of a wheel
`damage.life.life_table`      lives as a table, quantiles of the distance to the first turning
`damage.life.rates`           rates of wear and damage of a surface
`damage.life.forecast`        lives from constant rates
============================  ==========================================================================
"""
