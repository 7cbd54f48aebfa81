"""A whole line: its statistics as weighted track sections.

============  =======================================================================================
`line`        `read_line` (TOML) and `load_sections`
`line_data`   what a line's file holds
`line_file`   reads and checks it
============  =======================================================================================
"""
