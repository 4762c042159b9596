"""A recording that the test writes itself, byte by byte: rosbag2's SQLite file with CDR samples."""

import sqlite3
import struct


class Sample:
    """Plain CDR, little-endian: every number at a multiple of its size."""

    def __init__(self):
        self.body = b""

    def text(self, value):
        raw = value.encode() + b"\0"
        return self.number("I", len(raw)).raw(raw)

    def raw(self, data):
        self.body += data
        return self

    def number(self, code, *values):
        for value in values:
            size = struct.calcsize("<" + code)
            self.body += b"\0" * (-len(self.body) % size) + struct.pack("<" + code, value)
        return self

    def payload(self):
        return b"\0\1\0\0" + self.body


def attitude(step, spacecraft="sat1"):
    sample = Sample().text(spacecraft).text("fly").number("Q", step).number("q", 10_000_000 * step)
    return sample.number("d", 1, 0, 0, 0, 0, 0.1 * step, 1 / 3).number("I", 0).payload()


def momentum(step, spacecraft="sat1"):
    sample = Sample().text(spacecraft).text("fly").number("Q", step).number("q", 10_000_000 * step)
    return sample.number("d", *(0.1 * (i + step) for i in range(12))).number("I", 4).payload()


def wheel(step, name, spacecraft="sat1"):
    sample = Sample().text(spacecraft).text(name).text("fly").number("Q", step).number("q", 10_000_000 * step)
    return sample.number("d", 200.0, 4.0 / 3, 0.1 * step, -1e-3).number("I", 0).payload()


def pointing(step, flags, spacecraft="sat1"):
    sample = Sample().text(spacecraft).text("fly").number("Q", step).number("q", 10_000_000 * step)
    return sample.number("d", *(0.5 * i for i in range(17))).number("I", flags).payload()


TYPES = {
    "attitude_state": "AttitudeState",
    "momentum_state": "MomentumState",
    "wheel_state": "WheelState",
    "pointing_state": "PointingState",
}


def write(directory, messages):
    """messages: (topic, payload) in the order of their reception."""
    directory.mkdir()
    database = sqlite3.connect(directory / "made_0.db3")
    database.executescript(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
    )
    ids = {topic: i + 1 for i, topic in enumerate(TYPES)}
    for topic, number in ids.items():
        row = (number, f"/adstar/{topic}", f"adstar/msg/{TYPES[topic]}", "cdr", "")
        database.execute("INSERT INTO topics VALUES (?, ?, ?, ?, ?)", row)
    for i, (topic, payload) in enumerate(messages):
        row = (i + 1, ids[topic], 1_700_000_000_000_000_000 + i, payload)
        database.execute("INSERT INTO messages VALUES (?, ?, ?, ?)", row)
    database.commit()
    database.close()
    return directory
