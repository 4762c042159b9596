"""How much memory there is for arrays. Asked before they are made: memory that is not there is granted all the same.
What cannot be read, or says no number, constrains nothing."""

import re
import resource
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, Optional


def available_bytes(root: Path = Path("/")) -> int:
    """The least that the machine, the control groups of this process (a container's) and ``ulimit -v`` leave."""
    return min([*_of_machine(root), *_of_groups(root), *_below_limit(root)], default=sys.maxsize)


def _of_machine(root: Path) -> Iterator[int]:
    kibibytes = _said(root / "proc/meminfo", "MemAvailable:")
    if kibibytes is not None:
        yield 1024 * kibibytes


class Files(NamedTuple):
    """Where the control groups of a version are, and what says what. A group counts those below it too."""

    mount: str
    limit: str
    used: str
    idle: str


VERSION_1 = Files("sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file")
VERSION_2 = Files("sys/fs/cgroup", "memory.max", "memory.current", "inactive_file")


def _of_groups(root: Path) -> Iterator[int]:
    """What files have in memory and nobody has used lately makes way."""
    for line in _text(root / "proc/self/cgroup").split("\n"):
        controllers, _, group = line.partition(":")[2].partition(":")
        if not group.startswith("/") or controllers and "memory" not in controllers.split(","):
            continue
        files = VERSION_1 if controllers else VERSION_2
        for directory in _up_from(group, root / files.mount):
            most = _said(directory / files.limit)
            if most is not None:
                used = (_said(directory / files.used) or 0) - (_said(directory / "memory.stat", files.idle) or 0)
                yield max(0, most - max(0, used))


def _up_from(group: str, mount: Path) -> Iterator[Path]:
    """A container's own groups are at the mount, whatever they are called outside."""
    directory = mount / group.lstrip("/")
    yield directory
    while directory != mount:
        directory = directory.parent
        yield directory


def _below_limit(root: Path) -> Iterator[int]:
    most, _ = resource.getrlimit(resource.RLIMIT_AS)
    if most != resource.RLIM_INFINITY:
        pages = _said(root / "proc/self/statm") or 0
        yield max(0, most - pages * resource.getpagesize())


def _said(file: Path, name: str = "") -> Optional[int]:
    """The number after that name at the start of a line; without a name, the first that starts one."""
    found = re.search(rf"^{name} *([0-9]{{1,20}})(?!\S)", _text(file), re.MULTILINE)
    return int(found[1]) if found else None


def _text(file: Path) -> str:
    try:
        return file.read_text(errors="surrogateescape")
    except (OSError, ValueError):
        return ""
