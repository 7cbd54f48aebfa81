"""Variants of a campaign's file: what differs, shares, axle load, gauge, the same random numbers, bad keys."""

import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "life"))
