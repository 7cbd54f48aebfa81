"""Logs of a run as files on disk: what damage and playback live on.

`channels` names the columns, `store` writes parts and reads a run back. A part is renamed into place when it
is whole, so a run that was killed leaves all its finished parts readable. `wheel_forces` gives Q and Y of
every wheel over time.
"""
