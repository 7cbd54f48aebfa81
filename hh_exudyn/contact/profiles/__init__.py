"""Profiles of wheels and rails: shapes, files, measures, and the tables that kernels read.

=============  ======================================================================================
`profile`      `Profile`, a line z(y) in side coordinates, and its gauge point
`library`      the standard shapes by name, rails at any inclination
`standard`     S1002 and rail heads from their arcs
`malmbanan`    stand-ins for the profiles of the Malmbanan line, all assumed
`reader`       files of any format, cleaned and smoothed
`formats`      how a format is recognised by the content of a file
`points`       the points of a file in its own axes, and its lines
`two_columns`  plain tables, with or without a header
`miniprof`     MiniProf's files, with keys or with older headers
`simpack`      SIMPACK's files
`vampire`      VAMPIRE's files
`axes`         from the axes of a file to side coordinates
`cleaning`     double points, steps, points out of order
`gaps`         gaps and upright faces
`wild_points`  points off the curve of their neighbours
`smoothing`    the rule by which a measured profile is smoothed
`writer`       two columns, or text like MiniProf's
`measures`     flange height, thickness, qR and angle; rail head wear
`steepness`    steep spots that a table must not end at
`spline`       a profile as a spline table for kernels
=============  ======================================================================================

Arguments of the functions that read one format: `path`, the file, for messages, and `text`, its lines.
"""
