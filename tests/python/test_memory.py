"""What a run takes in memory, and that one which does not fit is refused before it starts."""

import re
import subprocess
import sys

import numpy as np
import pytest

import adstar
from adstar.memory import available_bytes
from test_propagate import MIXED
from test_scene import FREE


def bytes_of(motions):
    arrays = {id(value): value for motion in motions.values() for value in vars(motion).values()}
    return sum(value.nbytes for value in arrays.values() if isinstance(value, np.ndarray))


@pytest.mark.parametrize(("text", "duration_s"), [(FREE, 1000), (MIXED, 100)], ids=["free", "mixed"])
def test_a_run_is_refused_by_the_bytes_that_its_arrays_take_and_no_others(text, duration_s, monkeypatch):
    scene = adstar.parse_scene(text)
    taken = bytes_of(scene.propagate_all(duration_s))
    assert taken > 16e6  # or nobody asks
    monkeypatch.setattr("adstar.scene.available_bytes", lambda: taken)
    assert bytes_of(scene.propagate_all(duration_s)) == taken
    monkeypatch.setattr("adstar.scene.available_bytes", lambda: taken - 1)
    with pytest.raises(MemoryError, match=f"every_s: got 0.01, for which .* rows take {taken / 1e6:.1f} MB, expected"):
        scene.propagate_all(duration_s)


def test_a_row_takes_what_the_readme_says():
    assert bytes_of({"sat1": adstar.parse_scene(FREE).propagate(0.01)}) == 2 * (152 + 16)


def test_the_every_s_to_try_fits(monkeypatch):
    scene = adstar.parse_scene(FREE)
    monkeypatch.setattr("adstar.scene.available_bytes", lambda: 15_000_000)
    with pytest.raises(MemoryError, match="at most the 15.0 MB of memory that are free; try ") as caught:
        scene.propagate(1000)
    every_s = float(re.search("try (.*)", str(caught.value)).group(1))
    assert every_s == 0.03
    assert bytes_of({"sat1": scene.propagate(1000, every_s)}) < 7_500_000


def test_arrays_that_no_machine_holds_are_refused_at_once():
    said = r"every_s: got 0.01, for which 100,000,000,001 rows take 16800.0 GB, expected .*; try \d+"
    with pytest.raises(MemoryError, match=said):
        adstar.parse_scene(FREE).propagate(1e9)
    with pytest.raises(MemoryError, match="for which 2,000,000,000,000,000,001 rows take"):
        adstar.parse_scene(FREE).propagate(2e9 - 1e-9, 1e-9, step_s=1e-9)


UNDER_A_LIMIT = f"""
import adstar, resource
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + 400_000_000,) * 2)
adstar.parse_scene('''{FREE}''').propagate(1e5)
"""


def test_a_limit_on_the_process_counts():
    done = subprocess.run([sys.executable, "-c", UNDER_A_LIMIT], capture_output=True, text=True, check=False)
    assert re.search(r"MemoryError: every_s: got 0.01, .* take 1.7 GB, .* at most the \d+.\d MB", done.stderr), done


def machine(root, **groups):
    """One with 64 MiB available, and these control groups, by the name of their directory."""
    files = {
        "proc/meminfo": "MemTotal: 131072 kB\nMemAvailable: 65536 kB\n",
        "proc/self/cgroup": "1:cpu:/x\n0::/of/me\n",
    }
    for group, (most, current) in groups.items():
        files[f"sys/fs/cgroup/{group}/memory.max"] = most
        files[f"sys/fs/cgroup/{group}/memory.current"] = current
        files[f"sys/fs/cgroup/{group}/memory.stat"] = "anon 1\ninactive_file 1000\nactive_file 7\n"
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return root


@pytest.mark.parametrize(
    ("groups", "available"),
    [
        ({}, 64 << 20),
        ({"of/me": ("max\n", "5\n")}, 64 << 20),
        ({"of/me": ("30000\n", "5000\n")}, 26000),
        ({"of": ("20000\n", "5000\n"), "of/me": ("30000\n", "5000\n")}, 16000),
        ({"of/me": ("30000\n", "90000\n")}, 0),
        ({"of/another": ("30000\n", "5000\n")}, 64 << 20),
    ],
)
def test_available_is_what_the_narrowest_group_leaves(groups, available, tmp_path):
    assert available_bytes(machine(tmp_path, **groups)) == available


def test_what_motions_share_cannot_be_written():
    motions = adstar.parse_scene(MIXED).propagate_all(0.1)
    one, another = motions["plain"], motions["w"]
    assert one.time_s is another.time_s and one.step is another.step
    for shared in (one.time_s, one.step):
        with pytest.raises(ValueError, match="read-only"):
            shared[0] = 1
    one.q_IB[0] = 0
    assert another.q_IB[0, 0] == 1
