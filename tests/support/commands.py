"""The command in a process of its own, and what it leaves on disk."""

import os
import subprocess
import sys
from pathlib import Path


def command(*words: str | Path, code: str = "") -> subprocess.CompletedProcess[str]:
    """The command in a process of its own; `code` runs before it."""
    start = ["-c", f"{code}\nfrom hh_exudyn.cli.app import main\nmain()"]
    return subprocess.run(
        [sys.executable, *start, *(str(word) for word in words)],
        capture_output=True, text=True, cwd="/", env=os.environ | {"COLUMNS": "200"},
    )  # fmt: skip


def content(folder: Path) -> dict[str, bytes]:
    """Files of a run but its status (wall times) and its recording (numbers by which the viewer sorts)."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and path.name not in ("status.json", "playback.rrd")
    }
