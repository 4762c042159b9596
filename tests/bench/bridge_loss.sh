#!/usr/bin/env bash
# Does the tick notice when its bridge dies? A 1 kHz run in blocks: undisturbed, then with the bridge killed -9
# twice a second. Prints the tick body's p50, p99.9 and maximum of each block as adstard sums them up.
#   bash tests/bench/bridge_loss.sh [build/release] [blocks]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bin=${1:-build/release}
blocks=${2:-3}
scene=$(mktemp --suffix .toml)
log=$(mktemp)
trap 'rm -f "$scene" "$log"' EXIT
cat > "$scene" <<TOML
[simulation]
step = "1ms"
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[dds]
partition = "bridge_loss.$$"
TOML

run_block() {  # $1: undisturbed or killed
  local daemon child kills=0
  "$bin/adstard" "$scene" --duration 10s 2> "$log" &
  daemon=$!
  while kill -0 "$daemon" 2>/dev/null; do
    sleep 0.5
    child=$(cat "/proc/$daemon/task/$daemon/children" 2>/dev/null || true)
    if [[ "$1" == killed && -n "$child" ]] && grep -q propagates "$log"; then
      kill -9 ${child% } 2>/dev/null && kills=$((kills + 1)) || true
    fi
  done
  wait "$daemon"
  printf '%-12s %3d kills  %s; %s\n' "$1" "$kills" "$(grep -o 'tick body.*' "$log")" \
    "$(grep -oE '[0-9]+ steps' "$log" | tail -n 1)"
}

for ((block = 0; block < blocks; ++block)); do
  run_block undisturbed
  run_block killed
done
