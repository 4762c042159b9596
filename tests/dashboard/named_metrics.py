"""Every metric that an alert or a Grafana panel names is one that the dashboard's server gives; promtool, where it is
installed, has nothing against the alerts."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1])
given = set(re.findall(r'"(adstar_\w+)"', (root / "service/dashboard/server/metrics_text.cpp").read_text()))
rules = root / "deploy/prometheus/adstar.rules.yml"
board = json.loads((root / "deploy/grafana/adstar.json").read_text())
expressions = re.findall(r"expr: (.+)", rules.read_text())
expressions += [target["expr"] for panel in board["panels"] for target in panel["targets"]]
assert len(given) > 10 and len(expressions) > 10, "the files are not what this reads"
unknown = {re.sub("_bucket$", "", name) for text in expressions for name in re.findall(r"adstar_\w+", text)} - given
if unknown:
    sys.exit(f"nobody gives {sorted(unknown)}")
if shutil.which("promtool"):
    sys.exit(subprocess.run(["promtool", "check", "rules", rules]).returncode)
print("promtool is not installed: alerts not parsed")
