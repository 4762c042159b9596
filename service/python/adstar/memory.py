"""How much memory there is for arrays. Asked before they are made: memory that is not there is granted all the same."""

import resource
from collections.abc import Iterator
from pathlib import Path


def available_bytes(root: Path = Path("/")) -> int:
    """The least that the machine, the control groups of this process (a container's) and ``ulimit -v`` leave."""
    return min([_of_machine(root), *_of_groups(root), *_below_limit(root)])


def _of_machine(root: Path) -> int:
    return 1024 * _said((root / "proc/meminfo").read_text(), "MemAvailable:")


def _of_groups(root: Path) -> Iterator[int]:
    """Of version 2; what files have in memory and nobody has used lately makes way."""
    own = [line[3:] for line in (root / "proc/self/cgroup").read_text().splitlines() if line.startswith("0::/")]
    mount = root / "sys/fs/cgroup"
    for group in own:
        for directory in (mount / group.lstrip("/"), *(mount / group.lstrip("/")).parents):
            if (directory / "memory.max").exists():
                most = (directory / "memory.max").read_text().strip()
                if most != "max":
                    idle = _said((directory / "memory.stat").read_text(), "inactive_file")
                    yield max(0, int(most) - int((directory / "memory.current").read_text()) + idle)
            if directory == mount:
                break


def _below_limit(root: Path) -> Iterator[int]:
    most, _ = resource.getrlimit(resource.RLIMIT_AS)
    if most != resource.RLIM_INFINITY:
        pages = int((root / "proc/self/statm").read_text().split()[0])
        yield max(0, most - pages * resource.getpagesize())


def _said(text: str, name: str) -> int:
    return next(int(words[1]) for words in map(str.split, text.splitlines()) if words[0] == name)
