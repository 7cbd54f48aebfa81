"""Shakedown limits of line contact as sources print them (`tests/reference/shakedown_line_contact.csv`)."""

import csv
from pathlib import Path

_FILE = Path(__file__).resolve().parents[1] / "reference" / "shakedown_line_contact.csv"
LIMITS = list(csv.DictReader(line for line in _FILE.read_text().splitlines() if not line.startswith("#")))
