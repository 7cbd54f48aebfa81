"""A whole vehicle as a TOML file: read, written, and as a record with numbers that variants may change.

============  ========================================================================================
`layout`      what a vehicle file may have, read from the dataclasses of `vehicles.description`: sections,
              classes of their entries, unit of every field
`numbers`     one number as a file writes it: plain, with unit, with unit and source
`document`    the content of a file as a value: `Document`, its numbers by name and the `Vehicle` it builds
`reading`     tables of a file to a `Document`
`file`        the `Document` in a file, TOML or JSON
`writing`     a `Document` to tables and text
`mirror`      the right-hand copy of an entry
`export`      any vehicle as a `Document`: equal entries share a part
`tracing`     the source of every number of a vehicle that was built from sourced parameters
`templates`   files to start from
============  ========================================================================================

The grammar stands in `reading`. New couplings and new fields need no change here.
"""
