#!/usr/bin/env bash
# What recording takes: `adstar record` beside a daemon that publishes so many samples a second, on loopback.
#   bash tests/bench/record.sh [build/release] [seconds]
# Prints samples a second, the recorder's processor time by the wall's, its memory, and what it says of losses.
set -euo pipefail
build=$(cd "${1:-build/release}" && pwd)
seconds=${2:-20}
home=$(mktemp -d)
daemon=""
recorder=""
clean_up() {
  for started in $recorder $daemon; do
    kill -INT "$started" 2> /dev/null && wait "$started" 2> /dev/null || true
  done
  rm -rf "$home"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

# spacecraft, rate [Hz] of attitude and of momentum each
for load in "10 100" "20 1000" "50 1000"; do
  read -r count hz <<< "$load"
  partition="record.$$.$count"
  watched=$(seq -s, 0 $((count - 1)) | sed -E 's/([0-9]+)/"sat\1"/g')
  cat > "$home/scene.toml" << SCENE
[simulation]
step = "1ms"
[[spacecraft]]
name = "sat{}"
count = $count
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
[telemetry]
spacecraft = [$watched]
attitude_hz = $hz
momentum_hz = $hz
fleet_hz = 0
[dds]
partition = "$partition"
SCENE
  "$build/adstard" "$home/scene.toml" 2> "$home/log" &
  daemon=$!
  "$build/adstar" list --partition "$partition" --timeout 10s > /dev/null || {
    cat "$home/log" >&2
    exit 1
  }
  "$build/adstar" record "$home/bag.$count" --partition "$partition" --for "${seconds}s" > "$home/said" 2>&1 &
  recorder=$!
  peak=0
  ticks=0
  # state, ..., utime and stime, the 12th and 13th after the name; until it has ended
  while read -r -a fields < <(sed 's/.*) //' "/proc/$recorder/stat" 2> /dev/null) && [[ ${fields[0]} != Z ]]; do
    ticks=$((fields[11] + fields[12]))
    kb=$(awk '/VmRSS/ {print $2}' "/proc/$recorder/status" 2> /dev/null) || true  # it may have ended just now
    if [[ -n $kb ]] && ((kb > peak)); then peak=$kb; fi
    sleep 0.2
  done
  if ! wait "$recorder"; then
    recorder=""
    echo "record.sh: \`adstar record\` failed: $(< "$home/said")" >&2
    exit 1
  fi
  recorder=""
  kill -INT "$daemon" && wait "$daemon" || true
  daemon=""
  awk -v t="$ticks" -v hz="$(getconf CLK_TCK)" -v s="$seconds" -v kb="$peak" -v said="$(tail -n 1 "$home/said")" -v want=$((2 * count * hz)) \
    'BEGIN { printf "%6d samples a second asked: processor %4.1f %%, memory %3.0f MB; %s\n", want, 100 * t / hz / s, kb / 1024, said }'
done
