#!/usr/bin/env bash
# Injects one fault after the other into a 1 kHz run and prints what came of each, as a Markdown table.
#   bash tests/bench/faults.sh [--write] [build/release] [faults...]     --write: into service/pages/faults.md
# Builds nothing: cmake --build build/release --target adstar_tests fault_tool
#
# A fault is a function fault_NAME: it is called once the daemon flies, with $daemon its pid, and ends by itself or is
# ended with the run. Its line what="..." is what the table calls it. The second table is of faults of the daemon itself: the tests
# that inject them say what came of it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

write=false
if [[ "${1:-}" == --write ]]; then
  write=true
  shift
fi
bin=${1:-build/release}
shift || true
seconds=10
domain=97
partition=faults.$$

fault_none() { what="none"; }
fault_bridge_killed() { what="bridge killed (SIGKILL) once a second"; once_a_second KILL; }
fault_bridge_aborted() { what="bridge aborted (SIGABRT) once a second"; once_a_second ABRT; }
fault_bridge_stopped() { what="bridge stopped (SIGSTOP) for good"; kill -STOP "$(bridge)"; }
fault_flood() {
  what="commands at 10 times the beat, each from a new commander"
  "$bin/tests/bench/fault_tool" flood "$domain" "$partition" sat1 10000 $((seconds - 2))
}
fault_datagrams() {
  what="noise and mutated RTPS at every port of the bridge"
  "$bin/tests/bench/fault_tool" datagrams "$domain" "$daemon" $((seconds - 2))
}
fault_long_strings() {
  what="names of 100 kB in commands"
  "$bin/tests/integration/wild_commander" "$domain" "$partition" 100000 2000
}
fault_deaf_subscriber() {
  what="a reliable subscriber that stands still"
  "$bin/adstar" monitor --format csv --domain "$domain" --partition "$partition" > /dev/null &
  local monitor=$!
  sleep 2
  kill -STOP "$monitor"
  wait_for_daemon
  kill -KILL "$monitor"
}

bridge() { tr -d ' ' 2>/dev/null < "/proc/$daemon/task/$daemon/children" || true; }
wait_for_daemon() { while kill -0 "$daemon" 2>/dev/null; do sleep 0.1; done; }
once_a_second() {
  local pid
  while sleep 1; do
    pid=$(bridge)
    [[ -n "$pid" ]] || return 0
    kill -"$1" "$pid" 2>/dev/null || true
  done
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat > "$work/scene.toml" <<TOML
[simulation]
step = "1ms"
[[spacecraft]]
name = "sat1"
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[[spacecraft.torque]]
model = "commanded"
name = "body"
frame = "body"
max_torque_n_m = [1.0, 1.0, 1.0]
[telemetry]
attitude_hz = 100
momentum_hz = 100
[dds]
domain = $domain
partition = "$partition"
TOML

sum() { { grep -oE "[0-9]+ $1" "$log" || true; } | awk '{ n += $1 } END { print n + 0 }'; }

row() {  # fault
  log=$work/$1.log
  "$bin/adstard" "$work/scene.toml" --duration "${seconds}s" 2> "$log" &
  daemon=$!
  while ! grep -q propagates "$log"; do
    kill -0 "$daemon" || { cat "$log" >&2; exit 1; }
    sleep 0.05
  done

  "fault_$1" > "$work/$1.said" 2>&1 &
  local injector=$!
  wait "$daemon"
  # By its number alone it might be somebody else by now.
  if grep -qx "$injector" <<< "$(jobs -pr)"; then
    kill "$injector" 2>/dev/null || true
  fi
  wait "$injector" 2>/dev/null || true
  what=$(declare -f "fault_$1" | sed -n 's/.*what="\([^"]*\)".*/\1/p')
  local steps missed restarts lost body
  steps=$(grep -oE '[0-9]+ steps of' "$log" | tail -n 1 | cut -d' ' -f1)
  missed=$(grep -oE '[0-9]+ missed,' "$log" | tail -n 1 | cut -d' ' -f1)
  restarts=$(grep -c 'the bridge is started again' "$log" || true)
  lost="$(sum '(commands|datagrams) lost') / $(sum 'verdicts lost') / $(sum 'telemetry samples lost')"
  body=$(grep -oE 'tick body p50 [0-9.]+ us, p99.9 [0-9.]+' "$log" | awk '{ print $7 }')
  printf '| %s | %s of %s | %s | %s | %s | %s |\n' "$what" "$steps" $((seconds * 1000)) "$missed" "$restarts" \
    "$lost" "$body"
}

table() {
  echo "| fault, for $seconds s at 1 kHz | steps taken | beats missed | bridges started anew | commands / verdicts / telemetry lost, and said | tick body p99.9 [µs] |"
  echo "|---|---|---|---|---|---|"
  local fault
  for fault in "$@"; do
    row "$fault"
  done
}

falls=10
# What a test that passed says in its last line but gtest's.
said_by() {  # program, filter
  ADSTAR_KILLS=$falls "$bin/tests/integration/$1" --gtest_filter="$2" > "$work/$1.out" 2>&1 || { echo "FAILED"; return 0; }
  grep -E 'kills[,;]|^same bits' "$work/$1.out" | paste -sd ' ' | sed -E 's/^[0-9]+ kills[,;] //'
}
falls_table() {
  echo
  echo "| fault of the daemon | what came of it |"
  echo "|---|---|"
  echo "| killed (SIGKILL) $falls times, resumed each time | $(said_by kill_resume_test '*killed_at_any_moment*') |"
  echo "| killed (SIGKILL) $falls times under a standby, 200 Hz | $(said_by standby_test '*primary_is_killed') |"
  echo "| network between primary and standby split, healed | $(bash tests/integration/standby_split.sh "$bin" | tail -n 1 | sed -E 's/^ *[0-9]+ ms +//') |"
}

faults=("$@")
if [[ ${#faults[@]} -eq 0 ]]; then
  faults=(none bridge_killed bridge_aborted bridge_stopped flood datagrams long_strings deaf_subscriber none)
fi
{
  table "${faults[@]}"
  if [[ $# -eq 0 ]]; then falls_table; fi
} | tee "$work/table"

if [[ $write == true ]]; then
  sed -i -e '/<!-- faults: begin -->/,/<!-- faults: end -->/{//!d}' -e "/<!-- faults: begin -->/r $work/table" \
    service/pages/faults.md
fi
