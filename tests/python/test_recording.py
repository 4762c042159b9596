"""Recordings: the rows of `adstar export`, as arrays."""

import re
import warnings

import numpy as np
import pytest

import adstar
import made_recording as made
from programs import adstar as program, assert_same_table, rows_of


@pytest.fixture(name="directory")
def made_directory(tmp_path):
    messages = []
    for step in range(1, 40):
        for spacecraft in ("sat1", "sat2"):
            messages.append(("attitude_state", made.attitude(step, spacecraft)))
            if step % 2 == 0:
                messages.append(("momentum_state", made.momentum(step, spacecraft)))
        messages += [("wheel_state", made.wheel(step, name)) for name in ("wheel_x", "a wheel of length, too")]
        messages.append(("pointing_state", made.pointing(step, step % 4)))
    return made.write(tmp_path / "bag", messages)


@pytest.fixture(autouse=True)
def cut_off_recordings_are_expected():
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*was not ended", category=adstar.RecordingWarning)
        yield


@pytest.mark.parametrize("topic", ["motion", "attitude_state", "momentum_state", "wheel_state", "pointing_state"])
def test_has_the_rows_of_the_export(directory, topic):
    table = adstar.read_recording(directory)[topic]
    printed = rows_of(program("export", directory, "--to", "csv", "--topic", topic))
    if topic == "wheel_state":  # a CSV has no blanks in its names
        table["wheel"] = [re.sub("[ ,]", "?", name) for name in table["wheel"]]
    assert_same_table(table, printed)


def test_has_names_as_text_counts_as_integers_and_nan_for_what_was_not_said(directory):
    recording = adstar.read_recording(directory)
    assert recording["motion"].dtype["spacecraft"].kind == "U"
    assert recording["motion"].dtype["step"] == np.uint64
    halves = recording["motion"]["step"] % 2 == 1
    assert np.isnan(recording["motion"]["work_j"][halves]).all()
    assert not np.isnan(recording["motion"]["work_j"][~halves]).any()
    assert recording["motion"]["time_s"][0] == 0.01


def test_topics_without_rows_are_not_in_it_and_those_asked_for_alone_are(directory):
    everything = {"motion", "attitude_state", "momentum_state", "wheel_state", "pointing_state"}
    assert set(adstar.read_recording(directory)) == everything
    assert set(adstar.read_recording(directory, ["motion", "joint_state"])) == {"motion"}
    with pytest.raises(ValueError, match="topics: got 'wheel', expected some of motion, .*; try wheel_state"):
        adstar.read_recording(directory, ["wheel"])


def test_of_spacecraft_asked_for_alone(directory):
    one = adstar.read_recording(directory, spacecraft=["sat2"])
    assert set(one) == {"motion", "attitude_state", "momentum_state"}
    assert set(one["motion"]["spacecraft"]) == {"sat2"}
    with pytest.raises(ValueError, match="there is no 'sat3' in the recording; there are sat1, sat2"):
        adstar.read_recording(directory, spacecraft=["sat3"])


def test_says_that_nobody_ended_it_and_writes_nothing_there(directory):
    before = sorted(directory.iterdir())
    with pytest.warns(adstar.RecordingWarning, match="was not ended: was its recorder killed"):
        adstar.read_recording(directory)
    assert sorted(directory.iterdir()) == before


def test_says_what_is_lost_by_the_metadata_and_leaves_it(directory):
    told = 'rosbag2_bagfile_information:\n  version: 5\n  message_count: 1000\n  files:\n    - path: "made_1.db3"\n'
    told += "      message_count: 700\n"
    (directory / "metadata.yaml").write_text(told)
    with pytest.warns(adstar.RecordingWarning) as warned:
        motion = adstar.read_recording(directory)["motion"]
    assert len(motion) == 78
    lost = r"has 233 of the 1000 messages that its metadata.yaml tells of: made_1.db3 is missing; this is what is left"
    assert [bool(re.search(lost, str(w.message))) for w in warned] == [True]
    assert (directory / "metadata.yaml").read_text() == told


def test_leaves_out_samples_of_other_types_and_says_so(tmp_path):
    directory = made.write(
        tmp_path / "bag",
        [("attitude_state", made.attitude(1)), ("attitude_state", b"\0\1\0\0junk"), ("wheel_state", b"")],
    )
    with pytest.warns(adstar.RecordingWarning, match="left out: 1 of motion, 1 of attitude_state, 1 of wheel_state;"):
        recording = adstar.read_recording(directory)
    assert len(recording["attitude_state"]) == 1 and "wheel_state" not in recording


def test_what_is_no_recording_says_what_was_expected(tmp_path):
    with pytest.raises(adstar.RecordingError, match="there is no .db3 file in it"):
        adstar.read_recording(tmp_path)
    with pytest.raises(OSError, match="nowhere"):
        adstar.read_recording("nowhere")
