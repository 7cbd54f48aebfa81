"""Profiles as text files for this toolkit and others: two columns, or like a MiniProf file."""

from pathlib import Path

from hh_exudyn.contact.profiles.measures import flange_height, flange_steepness, flange_thickness
from hh_exudyn.contact.profiles.points import MINIPROF, TWO_COLUMN
from hh_exudyn.contact.profiles.profile import Profile
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE

WRITTEN_FORMATS = (TWO_COLUMN, MINIPROF)


def write_profile(profile: Profile, path: str | Path, format: str = TWO_COLUMN) -> None:
    """Write a profile as text, in millimetres with six decimals.

    Parameters
    ----------
    profile : Profile
        Wheel or rail.
    path : str or Path
        The file; an existing one is replaced.
    format : str
        ``"two_column"``: y and z in side coordinates under ``#`` lines that name profile, axes and units.
        ``"miniprof"``: ``key=value`` lines, then for a wheel X from the flange back to the field side and Y
        towards the flange tip, for a rail X towards the gauge side and Y upwards.

    Raises
    ------
    ValueError
        For another format.
    OSError
        The file cannot be written.

    Notes
    -----
    `reader.read_profile` returns the same points to a nanometre, if the profile is smooth enough not to be
    smoothed (as is any profile that the reader has smoothed).
    """
    if format not in WRITTEN_FORMATS:
        raise ValueError(f"format = {format!r}, allowed {', '.join(WRITTEN_FORMATS)}")
    x, y = 1e3 * profile.y, 1e3 * profile.z
    if format == TWO_COLUMN:
        zero = (
            "the running circle, 70 mm from the flange back" if profile.kind == "wheel" else "the file's own"
        )
        header = [
            f"# {profile.kind} profile {profile.name!r}, written by hh_exudyn",
            f"# y [mm]: towards the track centre, zero is {zero}; z [mm]: upwards",
        ]
    else:
        header = [f"Name={profile.name}", "ProgramName=hh_exudyn", "ColumnDef=X,Y", f"XYPoints={len(x)}"]
        if profile.kind == "wheel":
            x, y = 1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE - x, -y
            header += [
                f"WheelDiameterTaperline={1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE:.4f}",
                f"Sd={1e3 * flange_thickness(profile):.4f}",
                f"Sh={1e3 * flange_height(profile):.4f}",
                f"qR={1e3 * flange_steepness(profile):.4f}",
            ]
        else:
            header.append(f"Rail={profile.name}")
        header.append("")
    rows = [f"{a:.6f} {b:.6f}" for a, b in zip(x, y, strict=True)]
    Path(path).write_text("\n".join([*header, *rows]) + "\n", encoding="utf-8")
