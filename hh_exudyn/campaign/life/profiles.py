"""Profiles of a campaign as files under the hash of their points: what a case reads is what is compared.

DIR/3f2a91c07d5e4b68.txt    two columns, in millimetres to the nanometre
"""

import hashlib
from functools import cache
from pathlib import Path

import numpy as np

from hh_exudyn.contact.profile import Profile, read_wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile
from hh_exudyn.log.parts import TEMPORARY_SUFFIX

_DIGITS = 16


class ProfileFiles:
    """Wheel profiles in a folder.

    Parameters
    ----------
    directory
        Made with the first profile.
    """

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self._read = cache(lambda digest: read_wheel_profile(self.path(digest)))

    def path(self, digest: str) -> Path:
        """The file of a profile."""
        return self.directory / f"{digest}.txt"

    def put(self, profile: Profile) -> str:
        """Write a profile, if it is not there yet.

        Returns
        -------
        str
            Hash of its points, to the nanometre; its name does not count.
        """
        points = np.round(1e9 * np.column_stack([profile.y, profile.z])).astype(np.int64)
        digest = hashlib.sha256(points.tobytes()).hexdigest()[:_DIGITS]
        path = self.path(digest)
        if not path.is_file():
            self.directory.mkdir(parents=True, exist_ok=True)
            waiting = path.with_suffix(TEMPORARY_SUFFIX)
            write_profile(Profile(digest, profile.kind, profile.y, profile.z), waiting)
            waiting.replace(path)
        return digest

    def read(self, digest: str) -> Profile:
        """A profile as a case reads it; ValueError for one that is not there."""
        return self._read(digest)
