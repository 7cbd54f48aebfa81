"""A wheel profile over its life: worn step by step, measured, and turned back to shape.

    wear = profile_wear(surface, together="both")[wheel]        # how deep per kilometre, from a contact log
    history = evolve(profile, 0.4575, lambda worn: wear, 150e6, folder)
    history.to_table()                                          # Sh, Sd, qR, hollow, conicity, diameter

=====================================  =================================================================
`damage.evolution.profile_wear`        wear depth over the profile: of one wheel, of a wheelset, of both
                                       running directions
`damage.evolution.worn_profile`        a step of wear on a profile: normal to it, smoothed, valid again
`damage.evolution.measures`            flange measures, hollow and equivalent conicity of a profile
`damage.evolution.loop`                `evolve`: steps until a distance is run, resumable
`damage.evolution.tolerance`           steps of wheels, one or several together, sized by their error
`damage.evolution.step`                Euler and Heun with implicit diffusion of curvature; stability
`damage.evolution.running_in`          distance and depth of the wear under seizure of an unworn wheel
`damage.evolution.history`             the steps, on disk and as a table
`damage.evolution.reprofiling`         the smallest cut that restores a target profile
=====================================  =================================================================
"""
