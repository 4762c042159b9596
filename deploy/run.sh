#!/usr/bin/env bash
# From a bare Debian 12 to a flying spacecraft: installs what is missing, builds Release, starts adstard on the
# demo scene, drives it with a torque profile, shows its telemetry for ten seconds, stops it and sums up.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash deploy/install-deps.sh
echo "Building (build/release) ..."
cmake --preset release -DADSTAR_BUILD_TESTS=OFF >/dev/null
cmake --build build/release --target adstard adstar-bridge adstar

bin=build/release
log=$(mktemp)
daemon=""
driver=""
clean_up() {
  for pid in $driver $daemon; do
    kill -INT "$pid" 2>/dev/null && wait "$pid" 2>/dev/null || true
  done
  rm -f "$log"
}
trap clean_up EXIT

echo
echo "\$ adstard configs/scenes/demo.toml"
"$bin/adstard" configs/scenes/demo.toml 2>"$log" &
daemon=$!
for attempt in 1 2 3 4 5; do
  if "$bin/adstar" list --timeout 1s 2>/dev/null; then
    break
  elif [[ $attempt == 5 ]] || ! kill -0 "$daemon" 2>/dev/null; then
    cat "$log" >&2
    exit 1
  fi
done

echo
echo "\$ adstar torque sat1 --profile configs/scenes/demo_profile.csv"
"$bin/adstar" torque sat1 --profile configs/scenes/demo_profile.csv &
driver=$!

echo
echo "\$ adstar monitor sat1"
"$bin/adstar" monitor sat1 --for 10s
wait "$driver"
driver=""

kill -INT "$daemon"
wait "$daemon"
daemon=""
echo
echo "The run, as adstard sums it up:"
sed -nE 's/.* adstard info: ([0-9]+ (steps|commands)|tick body|wake-up)/  \1/p' "$log"
