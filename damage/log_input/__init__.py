"""Contact states from runs, files, tables and arrays.

================  ==================================================================================
`contact_source`  sources of contact states, read in batches
`contact_states`  the contact log in checked chunks
`bad_rows`        impossible rows: refused, or skipped and counted
`states`          the record of contact states, by the names of the log's columns
`output_clock`    the output interval of each row, found while the log is read
================  ==================================================================================
"""
