"""A whole line: its statistics as weighted track sections.

==============  =====================================================================================
`line`          `read_line` (TOML) and `load_sections`
`line_data`     the statistics of a line
`line_file`     the known lines by name; reads a line's file and checks it
`data_table`    tables of a line's file, every key with range and unit
`line_numbers`  all numbers of a line with unit and source
==============  =====================================================================================
"""
