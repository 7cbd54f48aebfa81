"""A campaign of made-up wear with as few cases as there are groups: for tests of many campaigns."""

from pathlib import Path

from made_up_campaign import campaign_file


def small_campaign_file(folder: Path, groups: str = "role") -> Path:
    """A campaign of single wagons with a case for straight track and one for curves, loaded and empty."""
    path = campaign_file(folder, groups)
    text = path.read_text(encoding="utf-8")
    assert text.count("runs = 8") == 1
    path.write_text(text.replace("runs = 8", "runs = 4"), encoding="utf-8")
    return path
