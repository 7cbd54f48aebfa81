"""The sums over the contact states are the same, bit for bit, however many threads make them."""

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pyarrow
import pytest

from damage.material import ER7
from damage.model import DamageModel
from damage.rcf.burstow import Burstow
from damage.report import assess
from damage.surface import accumulate as module
from damage.surface.accumulate import accumulate, usable_processors
from damage.surface.contact_sums import Sums
from damage.surface.wheel_surface import WheelSurface


def surface(log: pyarrow.Table, threads: int | None, chunk_rows: int = 100) -> WheelSurface:
    model = DamageModel(cells=(12, 12), burstow=Burstow.of(ER7))
    return accumulate(log, model, chunk_rows=chunk_rows, threads=threads)


@pytest.mark.parametrize("threads", [2, 3, 16, None])
def test_number_of_threads_does_not_matter(
    random_log: pyarrow.Table, monkeypatch: pytest.MonkeyPatch, threads: int | None
) -> None:
    monkeypatch.setattr(module, "BLOCK_ROWS", 7)  # many blocks a chunk, the last one short
    assert random_log.num_rows > 100
    alone, together = surface(random_log, 1), surface(random_log, threads)
    for field in fields(WheelSurface):
        one, other = getattr(alone, field.name), getattr(together, field.name)
        assert np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other, field.name


def test_blocks_add_up_to_the_whole(random_log: pyarrow.Table, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = surface(random_log, 1)
    monkeypatch.setattr(module, "BLOCK_ROWS", 1)
    pieces = surface(random_log, 1)
    for name in (*Sums._fields[:-1], "rcf_number", "corrected_rcf_number", "energy"):
        one, other = getattr(whole, name), getattr(pieces, name)
        np.testing.assert_allclose(other, one, rtol=1e-11, atol=1e-13 * np.abs(one).max())
        assert one.any()


def test_threads_are_checked(random_log: pyarrow.Table, make_log: Callable[..., pyarrow.Table]) -> None:
    assert usable_processors() >= 1
    for bad in (0, -2):
        with pytest.raises(ValueError, match=f"threads = {bad}"):
            surface(random_log, bad)
    bad_log = make_log(a=np.array([6e-3, -1.0]), force_x=1.0, force_y=0.0, moment_z=0.0)
    with pytest.raises(ValueError, match="a "):  # the pool lets an error of a chunk through
        assess(bad_log, cells=(5, 5), threads=2)
