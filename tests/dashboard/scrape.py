"""Debian's Prometheus scrapes the dashboard of a live daemon, all on loopback, and has its alerts; 77 where it is not installed.

    scrape.py PROGRAMS SOURCE
"""

import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request
from pathlib import Path

SCENE = """[simulation]
step = "10ms"
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
[service]
name = "scraped"
priority = 0
[dds]
partition = "{partition}"
"""
PATIENCE_S = 60


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def asked(port, path):
    with urllib.request.urlopen(f"http://127.0.0.1:{port}{path}", timeout=5) as answer:
        return json.load(answer)["data"]


def until(what, ask):
    """The first answer that is not empty; nobody may be connected yet."""
    patience_ends = time.monotonic() + PATIENCE_S
    while time.monotonic() < patience_ends:
        try:
            if answer := ask():
                return answer
        except OSError:
            pass
        time.sleep(0.2)
    sys.exit(f"no {what} within {PATIENCE_S} s")


def main():
    programs, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if not shutil.which("prometheus"):
        print("SKIPPED: no prometheus (bash deploy/install-deps.sh --tests)")
        return 77
    running = []
    with tempfile.TemporaryDirectory() as home:
        try:
            partition = f"scrape-{Path(home).name}"
            scene = Path(home) / "scene.toml"
            scene.write_text(SCENE.format(partition=partition))
            daemon = subprocess.Popen([programs / "adstard", scene], stderr=subprocess.DEVNULL)
            running.append(daemon)
            board = subprocess.Popen([programs / "adstar", "dashboard", "--port", "0", "--partition", partition],
                                     stdout=subprocess.PIPE, text=True)
            running.append(board)
            said = board.stdout.readline()
            port = int(re.search(r"127\.0\.0\.1:(\d+)", said).group(1))
            config = Path(home) / "prometheus.yml"
            config.write_text(json.dumps({  # JSON is YAML
                "global": {"scrape_interval": "1s", "evaluation_interval": "1s"},
                "rule_files": [str(source / "deploy/prometheus/adstar.rules.yml")],
                "scrape_configs": [{"job_name": "adstar",
                                    "static_configs": [{"targets": [f"127.0.0.1:{port}"]}]}]}))
            own = free_port()
            running.append(subprocess.Popen(
                ["prometheus", f"--config.file={config}", f"--storage.tsdb.path={home}/data",
                 f"--web.listen-address=127.0.0.1:{own}"], stderr=subprocess.DEVNULL))

            def value(query):
                found = asked(own, "/api/v1/query?query=" + urllib.parse.quote(query))["result"]
                return found and float(found[0]["value"][1])

            assert until("daemon that is up", lambda: value('adstar_up{service="scraped"}')) == 1
            assert until("steps", lambda: value("adstar_steps_total")) > 0
            assert until("lateness", lambda: value('adstar_phase_seconds{phase="wake_up",quantile="0.99"}')) > 0
            wake_up = 'adstar_phase_duration_seconds_bucket{phase="wake_up"}'
            assert until("histogram", lambda: value(f"histogram_quantile(0.99, {wake_up})")) > 0
            rules = until("alerts", lambda: asked(own, "/api/v1/rules")["groups"])[0]["rules"]
            bad = [rule["name"] for rule in rules if rule["health"] == "err"]
            assert not bad, f"alerts that do not work: {bad}"
            daemon.kill()
            until("alert of a daemon that was killed",
                  lambda: value('ALERTS{alertname="AdstarSilent",alertstate="firing",service="scraped"}'))
            running.append(subprocess.Popen([programs / "adstard", scene], stderr=subprocess.DEVNULL))
            until("end of that alert", lambda: value('adstar_up{service="scraped"}') == 1)
            print(f"scraped; {len(rules)} alerts")
        finally:
            for process in reversed(running):
                process.send_signal(signal.SIGTERM)
            for process in running:
                process.wait(timeout=20)
    return 0


sys.exit(main())
