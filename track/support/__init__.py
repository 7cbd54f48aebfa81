"""Flexibility of the track under a wheelset.

==============  =====================================================================================
`sleepers`      parameter sets of tracks on sleepers, exact receptance of their rails
`flexibility`   from sleepers to the lumped track under a wheelset, by name
`numbers`       units and ranges of the numbers of both
`substructure`  rails on pads on a sleeper on ballast under one wheelset: forces (kernel)
==============  =====================================================================================
"""
