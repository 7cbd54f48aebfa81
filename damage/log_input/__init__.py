"""Contact states from runs, files, tables and arrays.

==================  =================================================================================
`contact_source`    where contact states come from
`contact_states`    the contact log in checked chunks
`bad_rows`          rows that no contact can have: refused, or skipped and counted
==================  =================================================================================
"""
