#!/usr/bin/env bash
# What deploy/README.md says, done: one machine, two machines, a fleet in shards over two machines with a standby each. The
# machines are network namespaces whose wire is called eth0; the scenes are those of deploy/scenes and configs/scenes as they are,
# the keys are made by deploy/security/make.sh, and the daemons are started by what adstard@.service starts.
#   bash tests/package/deployments.sh [build/release]
# Builds nothing: cmake --build build/release --target adstard adstar-bridge adstar
# Needs root and iproute2; where namespaces cannot be made, it says so and its exit code is 77.
set -euo pipefail

bin=$(cd "${1:-build/release}" && pwd)
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
hosts=(flight plant)
wire=eth0
work=$(mktemp -d)
source "$source/tests/support/proof.sh"
source "$source/tests/support/two_hosts.sh"
source "$source/tests/support/typed.sh"

fail() {
  echo "deployments.sh: FAILED: $*" >&2
  local log
  for log in "$work"/*.log; do
    echo "---- $log" >&2
    tail -n 40 "$log" >&2
  done
  exit 1
}
clean_up() {
  end_daemons
  remove_wire
  rm -rf "$work"
}
trap clean_up EXIT

# start HOST NAME [standby]: as adstard@NAME of that host would; its /etc/adstar and /var/lib/adstar are of the host's own.
start() {
  local role=${3:-primary} environment=()
  local daemon="$2 ($role, $1)"
  if [[ $role == standby ]]; then
    mapfile -t environment < <(sed -n 's/^Environment=//p' "$source/deploy/systemd/standby.conf")
  fi
  : > "$work/$daemon.log"
  ip netns exec "$(netns "$1")" env ADSTARD="$bin/adstard" CONFIGURATION_DIRECTORY="$work/$1/etc" STATE_DIRECTORY="$work/$1/var" \
    INVOCATION_ID=$RANDOM "${environment[@]}" sh "$source/deploy/systemd/fly.sh" "$2" 2>> "$work/$daemon.log" &
  pid[$daemon]=$!
}
says() { grep -q "$2" "$work/$1.log" || { flying "$1" || fail "the $1 has ended, and never said '$2'"; false; }; }
stop() {
  kill -INT "${pid[$1]}"
  ends_with "$1" 0
}

fall() {
  kill -KILL "${pid[$1]}"
  ends_with "$1" 137
}

adstar() { timeout 30 ip netns exec "$(netns "$1")" "$bin/adstar" "${@:2}"; }  # host, verb and operands
list() { adstar "$1" list --timeout 1s "${@:2}" 2> /dev/null || true; }
listed() { list "$1" "${@:3}" | grep -q "^service '$2': running"; }  # host, service, options

as_said() {  # host, section of deploy/README.md, which lines, what to put for its names: done in the host's own /var/lib/adstar
  local lines
  lines=$(typed "$source/deploy/README.md" "$2" "$3" | sed -e "$4" -e "s|/var/lib/adstar|$work/$1/var|g")
  (cd "$work/$1/var" && eval "$lines")
}

lay_out() {  # scenes, the same on each host, with the keys beside them
  local host scene
  for host in "${hosts[@]}"; do
    mkdir -p "$work/$host/etc" "$work/$host/var"
    for scene in "$@"; do
      cp "$source/$scene" "$work/$host/etc/"
    done
    cp -r "$work/keys" "$work/$host/etc/keys"
  done
}

skip_without_wire deployments.sh
bash "$source/deploy/security/make.sh" "$work/keys" > /dev/null
make_wire
lay_out configs/scenes/demo.toml deploy/scenes/{two_machines,shard_a,shard_b}.toml
secured=(--interface eth0 --domain 7 --security "$work/keys/commander")

# ---- one machine --------------------------------------------------------------------------------------
one="demo (primary, plant)"
sed -i 's/^\[simulation\]/[budget]\nadmission = "warn"\n&/' "$work/plant/etc/demo.toml"  # on whatever the tests run on
start plant demo
await 20 "the demo flies" says "$one" "propagates 1 spacecraft"
adstar plant torque sat1 --torque-n-m 0 0 0.05 --for 100ms > "$work/verdict" || fail "a command: $(cat "$work/verdict")"
code=0
adstar flight list --interface eth0 --timeout 1s > "$work/listed" 2>&1 || code=$?
[[ $code == 4 ]] || fail "another machine hears what flies on loopback, or cannot listen (exit code $code): $(cat "$work/listed")"
proved "one machine: $(head -n 1 "$work/verdict"); on eth0 nothing of it is heard"
stop "$one"
start plant demo
await 20 "the demo flies again" says "$one" "propagates 1 spacecraft"
says "$one" "the run goes on at step" || fail "the run did not go on"
! grep -E 'is not what|is gone' "$work/$one.log" || fail "something is said to be lost after a stop, or the scene to be another"
stop "$one"
echo '# edited' >> "$work/plant/etc/demo.toml"
start plant demo
await 20 "the demo flies again" says "$one" "propagates 1 spacecraft"
says "$one" "is not what .* began with: the run goes on with its own scene" || fail "an edited scene is not noticed"
stop "$one"
proved "started again: the run goes on; with an edited scene too, and that is said"
mv "$work/plant/etc/demo.toml" "$work/demo.toml"
start plant demo
await 20 "the demo flies again" says "$one" "propagates 1 spacecraft"
says "$one" "etc/demo.toml is missing: the run goes on with its own scene" || fail "a missing scene is not noticed"
! grep -q 'rm -r' "$work/$one.log" || fail "a missing scene is taken for another"
stop "$one"
mv "$work/demo.toml" "$work/plant/etc/demo.toml"
proved "without its scene's file too, and the file is named"
rm -r "$work/plant/var/demo"
: > "$work/$one.log"
start plant demo
await 20 "the demo flies anew" says "$one" "propagates 1 spacecraft"
! grep -q 'goes on' "$work/$one.log" || fail "the run went on although it was removed"
stop "$one"
proved "with its run removed, it begins with the scene as it is now"

# ---- two machines -------------------------------------------------------------------------------------
plant="two_machines (primary, plant)"
sed -i 's/^\[simulation\]/[budget]\nadmission = "warn"\n&/' "$work/plant/etc/two_machines.toml"
start plant two_machines
await 20 "the plant flies" says "$plant" "propagates 1 spacecraft"
adstar flight torque sat1 --torque-n-m 0 0 0.05 --for 100ms "${secured[@]}" > "$work/verdict" 2>&1 ||
  fail "a command from the other machine: $(cat "$work/verdict")"
samples=$(adstar flight monitor sat1 --for 1s --format csv "${secured[@]}" 2> /dev/null | grep -c sat1 || true)
((samples > 20)) || fail "the other machine heard $samples samples in a second"
proved "two machines: $(head -n 1 "$work/verdict"); $samples samples heard in a second"
code=0
adstar flight torque sat1 --torque-n-m 0 0 0.05 --for 100ms --interface eth0 --domain 7 --timeout 2s > "$work/verdict" 2>&1 || code=$?
[[ $code == 4 ]] || fail "without keys a command ends with exit code $code: $(cat "$work/verdict")"
adstar flight torque sat1 --torque-n-m 0 0 0.05 --for 100ms --interface eth0 --domain 7 \
  --security "$work/keys/watcher" > "$work/verdict" 2>&1 && fail "a watcher commands" || code=$?
[[ $code == 3 ]] || fail "a watcher's command ends with exit code $code: $(cat "$work/verdict")"
proved "without keys nothing is heard, and a watcher may not command"
stop "$plant"

# ---- a fleet in shards --------------------------------------------------------------------------------
for shard in shard_a:flight:plant shard_b:plant:flight; do
  IFS=: read -r name home other <<< "$shard"
  start "$home" "$name"
  await 30 "$name flies" says "$name (primary, $home)" "propagates 500 spacecraft"
  start "$other" "$name" standby
  await 30 "the standby of $name follows" says "$name (standby, $other)" "follows from step"
done
proved "a fleet: two shards of 500 fly, each with a standby on the other machine"
for shard in a b; do
  await 20 "shard $shard on the wire" listed flight "shard_$shard" "${secured[@]}" --partition "shard_$shard"
done
first() { list flight "${secured[@]}" --partition shard_a > "$work/listed"; grep -q "'shard_a': running" "$work/listed"; }
await 20 "shard a by its partition" first
! grep -q "'shard_b" "$work/listed" || fail "who listens to shard a hears shard b: $(cat "$work/listed")"
both() { list flight "${secured[@]}" --partition 'shard_*' > "$work/listed"; grep -q "'shard_a': running" "$work/listed" && grep -q "'shard_b': running" "$work/listed"; }
await 20 "both shards by a wildcard" both
proved "each is heard in its partition alone, both in 'shard_*'"

fall "shard_a (primary, flight)"
await 15 "the standby takes over" says "shard_a (standby, plant)" "the primary is gone"
await 20 "shard a is back" listed flight shard_a "${secured[@]}" --partition shard_a
adstar flight torque a000 --torque-n-m 0 0 1e-4 --for 100ms "${secured[@]}" --partition shard_a > "$work/verdict" 2>&1 ||
  fail "a command to the one that took over: $(cat "$work/verdict")"
flying "shard_b (primary, plant)" && flying "shard_b (standby, flight)" || fail "shard b was touched"
proved "shard a is killed: its standby goes on, $(head -n 1 "$work/verdict")"
start flight shard_a
ends_with "shard_a (primary, flight)" 3
proved "the lost one comes back by itself, and is refused: $(tail -n 1 "$work/shard_a (primary, flight).log" | cut -c 1-120)"
mv "$work/flight/var/shard_a" "$work/flight/var/shard_a.lost"
start flight shard_a standby
await 30 "a new standby follows" says "shard_a (standby, flight)" "follows from step"
proved "the other machine stands by for shard a now"

fall "shard_a (standby, plant)"
await 15 "the new standby takes over" says "shard_a (standby, flight)" "the primary is gone"
await 20 "shard a is back" listed plant shard_a "${secured[@]}" --partition shard_a
proved "the one that took over is killed: the new standby goes on"
fall "shard_a (standby, flight)"
as_said flight "The one that took over" "^mv" "s/NAME/shard_a/g; s/standby-ID/standby-*/"
start flight shard_a
await 30 "its run goes on" says "shard_a (primary, flight)" "the run goes on at step"
await 20 "shard a is back" listed plant shard_a "${secured[@]}" --partition shard_a
proved "killed with nobody behind it, it is made the primary: $(grep -o 'the run goes on at step [0-9]*' "$work/shard_a (primary, flight).log")"
as_said flight "Old runs" . "s/OLD/shard_a.lost/"
as_said plant "Old runs" . "s/OLD/shard_a.standby-*/"
[[ ! -e "$work/flight/var/shard_a.lost" ]] || fail "an old run is still there"
start plant shard_a standby
await 30 "it is followed" says "shard_a (standby, plant)" "follows from step"
proved "old runs are removed, and it is followed again"
