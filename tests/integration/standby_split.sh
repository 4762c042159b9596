#!/usr/bin/env bash
# A primary and its standby, each in a network namespace of its own: the wire between them is cut, and both fly; it is
# mended, and the one of the lower term ends, the other flies on. Once with the primary's end of the wire down, once
# with the standby's. Prints a line for each thing proved.
#   bash tests/integration/standby_split.sh [build/release]
# Builds nothing: cmake --build build/release --target adstard adstar-bridge adstar
# Needs root and iproute2; where namespaces cannot be made, it says so and its exit code is 77.
set -euo pipefail

bin=${1:-build/release}
for program in adstard adstar-bridge adstar; do
  [[ -x "$bin/$program" ]] || { echo "standby_split.sh: $bin/$program is missing; build it" >&2; exit 2; }
done

hosts=(primary standby)
wire=link0  # by the same name at both ends, so that both daemons read the same scene
domain=77
work=$(mktemp -d)
run=$work       # of this round: scene, run directories, logs

support=$(dirname "${BASH_SOURCE[0]}")/../support
source "$support/proof.sh"
source "$support/two_hosts.sh"

fail() {
  echo "standby_split.sh: FAILED: $*" >&2
  local side
  for side in "${hosts[@]}"; do
    echo "---- log of the $side" >&2
    # Of the cut wire Cyclone says hundreds of lines.
    { grep -v 'failed with retcode' "$run/$side.log" || true; } | tail -n 60 >&2
  done
  exit 1
}

start() {  # side, options
  : > "$run/$1.log"  # for those who look before the daemon is there
  ip netns exec "$(netns "$1")" "$bin/adstard" "$run/scene.toml" --run "$run/$1" "${@:2}" 2> "$run/$1.log" &
  pid[$1]=$!
}

logged() { grep -m 1 -oE "$2.*" "$run/$1.log"; }  # side, what it says: from there to the end of the line
says() { logged "$@" > /dev/null || { flying "$1" || fail "the $1 has ended, and never said '$2'"; false; }; }

clean_up() {
  end_daemons
  remove_wire
  rm -rf "$work"
}
trap clean_up EXIT

adstar() {  # side, verb and operands
  timeout 30 ip netns exec "$(netns "$1")" "$bin/adstar" "${@:2}" --interface link0 --domain "$domain"
}

obeyed() {  # side where the command is given; what is said of it, in $verdict
  verdict=$(adstar "$1" torque sat1 --torque-n-m 0 0 0.05 --for 100ms 2>&1) || fail "a command beside the $1: $verdict"
  [[ $verdict == "applied by 'fly'"* ]] || fail "a command beside the $1: $verdict"
}

# The step of the daemon that flies, as a client beside it hears; 0 when it hears none.
step_heard() {
  local step
  step=$({ adstar "$1" list --timeout 400ms 2> /dev/null || true; } |
    sed -n "s/^service 'fly': running, step \([0-9,]*\) .*/\1/p")
  echo $((${step//,/} + 0))
}
heard_beyond() { (($(step_heard "$1") > $2)); }

newest_checkpoint() {
  local files=("$run/$1"/checkpoint-*.bin)
  local number=${files[-1]##*-}
  echo $((10#${number%.bin}))
}
written_beyond() { (($(newest_checkpoint "$1") > $2)); }

goes_on() {  # side whose end of the wire is up
  await 15 "a client beside the $1 hears the one that flies" heard_beyond "$1" 0
  await 15 "a client beside the $1 hears further steps" heard_beyond "$1" "$(step_heard "$1")"
}

round() {  # side whose end of the wire goes down
  local cut=$1 whole=standby side before mended_ms
  [[ $cut == primary ]] || whole=primary
  run=$work/cut_at_$cut
  mkdir "$run"
  scene > "$run/scene.toml"
  make_wire

  start primary
  await 20 "the primary flies" says primary propagates
  start standby --standby
  await 20 "the standby follows" says standby "follows from step"
  proved "the standby $(logged standby 'follows from step')"
  obeyed primary
  proved "the primary obeys: $verdict"

  ip -n "$(netns "$cut")" link set link0 down
  await 10 "the standby takes over" says standby "the primary is gone"
  proved "the wire is cut at the $cut: $(logged standby 'the primary is gone')"
  # By checkpoints, a second apart: no client can speak on an interface that is down. The one after the next is of
  # after the cut for certain, and by then Cyclone has forgotten the other side (2 s), which is the harder case.
  for side in "${hosts[@]}"; do
    before=$(newest_checkpoint "$side")
    await 20 "checkpoints of the $side" written_beyond "$side" $((before + 1))
    flying "$side" || fail "the $side ended while the wire was cut"
  done
  goes_on "$whole"
  obeyed "$whole"
  [[ -z "$(logged primary 'another daemon took over')" ]] || fail "the wire is not cut"
  proved "both fly; the $whole obeys: $verdict"

  # The address has stayed and the route comes back by itself; multicast needs none, the sockets are bound to link0.
  mended_ms=$(now_ms)
  ip -n "$(netns "$cut")" link set link0 up
  ends_with primary 3
  proved "the primary ends with exit code 3, $(($(now_ms) - mended_ms)) ms after the wire is mended"
  says primary "another daemon took over in term 2"
  proved "and says: $(logged primary 'another daemon took over')"
  flying standby || fail "the standby ended as well"
  goes_on standby
  obeyed standby
  proved "the standby flies on and obeys: $verdict"

  kill -INT "${pid[standby]}"
  ends_with standby 0
  proved "SIGINT ends the standby with exit code 0"
  replays standby
  replays primary
  remove_wire
}

replays() {  # side
  local said
  said=$("$bin/adstar" replay "$run/$1" 2>&1) || fail "the run of the $1 replayed: $said"
  [[ $said == "step 0 to"*"same bits" ]] || fail "the run of the $1 replayed: $said"
  proved "the run of the $1 replayed: ${said//$'\n'/; }"
}

scene() {
  cat <<TOML
[simulation]
step = "1ms"
duration = "endless"
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
[service]
name = "fly"
[budget]
admission = "warn"
[run]
checkpoint_every = "1s"
history = "whole"
[standby]
lead = "20ms"
lease = "100ms"
[dds]
domain = $domain
interface = "link0"
TOML
}

skip_without_wire standby_split.sh
for side in "${hosts[@]}"; do
  round "$side"
done
