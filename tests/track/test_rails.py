"""The two rails: which profile comes from where."""

from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import rail_profile, read_rail_profile
from track.rails import Rails


def test_names_are_standard_profiles_with_the_inclination() -> None:
    rails = Rails("60E1", "60E1", inclination=1.0 / 40.0)
    expected = rail_profile("60E1", inclination=1.0 / 40.0)
    for profile in (rails.left_profile(), rails.right_profile()):
        assert np.array_equal(profile.y, expected.y)
        assert np.array_equal(profile.z, expected.z)
    upright = Rails("60E1", inclination=0.0).left_profile()
    assert not np.array_equal(upright.z, expected.z)


def test_paths_are_read_as_they_lie(tmp_path: Path) -> None:
    """A measured profile keeps the inclination of its file, whatever the rails' own."""
    standard = rail_profile("60E1", inclination=1.0 / 30.0)
    measured = tmp_path / "measured.txt"
    np.savetxt(measured, 1e3 * np.column_stack([standard.y, standard.z]), fmt="%.9f")
    rails = Rails(left=str(measured), right="60E1", inclination=1.0 / 40.0)
    assert np.array_equal(rails.left_profile().z, read_rail_profile(measured).z)
    assert np.array_equal(rails.right_profile().z, rail_profile("60E1", inclination=1.0 / 40.0).z)


def test_bad_input_says_what_is_wrong() -> None:
    with pytest.raises(ValueError, match=r"inclination of Rails is 0.5 \(slope\), allowed are 0 to 0.1"):
        Rails(inclination=0.5)
    with pytest.raises(ValueError, match="no such rail"):
        Rails(left="no such rail").left_profile()
