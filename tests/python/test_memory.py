"""What a run takes in memory, and that one which does not fit is refused before it starts."""

import re
import resource
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


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (FREE, r"spacecraft: got 1, for which even two rows take 336 B, .* the 335 B of .*; try more memory \(no every_s"),
        (MIXED, "spacecraft: got 4, for which even two rows take .* free; try fewer spacecraft, or more memory"),
    ],
    ids=["one", "several"],
)
def test_where_two_rows_do_not_fit_no_every_s_is_named(text, said, monkeypatch):
    monkeypatch.setattr("adstar.scene.available_bytes", lambda: 335)
    with pytest.raises(MemoryError, match=f"^{said}"):
        adstar.parse_scene(text).propagate_all(1000)


def test_where_two_rows_fit_the_every_s_to_try_is_the_whole_run(monkeypatch):
    monkeypatch.setattr("adstar.scene.available_bytes", lambda: 336)
    with pytest.raises(MemoryError, match="^every_s: got 0.01, .* free; try 1000$"):
        adstar.parse_scene(FREE).propagate_all(1000)


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


def machine(root, **files):
    """One with 64 MiB available and these files besides; None takes one away."""
    files = {
        "proc/meminfo": "MemTotal: 131072 kB\nMemAvailable: 65536 kB\n",
        "proc/self/cgroup": "7:cpu,cpuacct:/x\n4:memory:/of/me\n1:name=systemd:/x\n0::/of/me\n",
        **files,
    }
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        if text is not None:
            (root / name).write_bytes(text.encode(errors="surrogateescape"))
    return root


def version_1(group, most, used, idle="inactive_file 3\ntotal_inactive_file 1000\n"):
    at = f"sys/fs/cgroup/memory/{group}/memory"
    return {f"{at}.limit_in_bytes": most, f"{at}.usage_in_bytes": used, f"{at}.stat": idle}


def version_2(group, most, used, idle="anon 1\ninactive_file 1000\nactive_file 7\n"):
    at = f"sys/fs/cgroup/{group}/memory"
    return {f"{at}.max": most, f"{at}.current": used, f"{at}.stat": idle}


NO_LIMIT = {version_1: "9223372036854771712\n", version_2: "max\n"}


@pytest.fixture(params=[version_1, version_2], ids=["version 1", "version 2"])
def group(request):
    """Files of a control group of either version."""
    return request.param


def test_a_machine_without_groups_leaves_what_is_available(tmp_path):
    assert available_bytes(machine(tmp_path)) == 64 << 20


def test_a_group_without_a_limit_constrains_nothing(group, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", NO_LIMIT[group], "5\n"))) == 64 << 20


def test_a_group_leaves_what_it_does_not_use_and_what_files_leave_idle(group, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", "30000\n", "5000\n"))) == 26000


def test_the_narrowest_of_the_groups_above_counts(group, tmp_path):
    groups = {**group("of", "20000\n", "5000\n"), **group("of/me", "30000\n", "5000\n")}
    assert available_bytes(machine(tmp_path, **groups)) == 16000


def test_a_container_finds_its_group_at_the_mount(group, tmp_path):
    assert available_bytes(machine(tmp_path, **group(".", "30000\n", "5000\n"))) == 26000


def test_a_group_that_is_over_its_limit_leaves_nothing(group, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", "30000\n", "90000\n"))) == 0


def test_the_group_of_another_does_not_count(group, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/another", "30000\n", "5000\n"))) == 64 << 20


ODD = [None, "", "\n", "\n\n", "max\n", "-1\n", "12.5\n", "0x10\n", "9" * 5000, "\udcff\0", ":", "::", "a:b\n"]


@pytest.mark.parametrize("odd", ODD, ids=ascii)
def test_a_limit_that_says_no_number_constrains_nothing(group, odd, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", odd, "5000\n"))) == 64 << 20


@pytest.mark.parametrize("odd", ODD, ids=ascii)
def test_a_use_that_says_no_number_leaves_the_limit(group, odd, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", "30000\n", odd))) == 30000


@pytest.mark.parametrize("odd", [*ODD, "inactive_file\n", "inactive_file x\n", "\ninactive_files 9\n"], ids=ascii)
def test_idle_memory_that_is_not_told_is_none(group, odd, tmp_path):
    assert available_bytes(machine(tmp_path, **group("of/me", "30000\n", "5000\n", odd))) == 25000


def test_odd_lines_beside_those_that_are_read_do_not_matter(tmp_path):
    files = version_2("of/me", "\n30000\n", "5000\n", "\n\nanon\n \ninactive_file 1000\n")
    files["proc/self/cgroup"] = "\nodd\n:\n0::\n0::/of/me\n\n"
    files["proc/meminfo"] = "\n\nodd\nMemAvailable: 65536 kB\n"
    assert available_bytes(machine(tmp_path, **files)) == 26000


@pytest.mark.parametrize("odd", ODD, ids=ascii)
def test_groups_that_are_not_told_constrain_nothing(group, odd, tmp_path):
    files = {**group("of/me", "30000\n", "5000\n"), "proc/self/cgroup": odd}
    assert available_bytes(machine(tmp_path, **files)) == 64 << 20


@pytest.mark.parametrize("odd", [*ODD, "MemAvailable:\n", "MemFree: 5 kB\n"], ids=ascii)
def test_a_machine_that_does_not_say_what_is_available_constrains_nothing(group, odd, tmp_path):
    files = {**group("of/me", "30000\n", "5000\n"), "proc/meminfo": odd}
    assert available_bytes(machine(tmp_path, **files)) == 26000


def test_where_nothing_can_be_read_nothing_constrains(tmp_path, monkeypatch):
    monkeypatch.setattr(resource, "getrlimit", lambda which: (resource.RLIM_INFINITY,) * 2)
    assert available_bytes(tmp_path) == sys.maxsize


@pytest.mark.parametrize("odd", ODD, ids=ascii)
def test_a_process_that_does_not_say_how_large_it_is_has_its_limit(odd, tmp_path, monkeypatch):
    monkeypatch.setattr(resource, "getrlimit", lambda which: (50000, 90000))
    assert available_bytes(machine(tmp_path, **{"proc/self/statm": odd})) == 50000


def test_what_motions_share_cannot_be_written():
    motions = adstar.parse_scene(MIXED).propagate_all(0.1)
    one, another = motions["plain"], motions["w"]
    assert one.time_s is another.time_s and one.step is another.step
    for shared in (one.time_s, one.step):
        with pytest.raises(ValueError, match="read-only"):
            shared[0] = 1
    one.q_IB[0] = 0
    assert another.q_IB[0, 0] == 1
