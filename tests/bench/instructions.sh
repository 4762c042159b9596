#!/usr/bin/env bash
# Instructions a step of a scene without models, beside those of the plain rigid body; fails past 2 % more.
#   instructions.sh PROGRAM
set -euo pipefail

program=$1
steps=20000
if ! command -v valgrind > /dev/null; then
  echo "SKIPPED: no valgrind (apt-get install valgrind)"
  exit 77
fi

count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$1" 2>&1 |
    awk '/Collected/ { print $NF }'
}

nothing=$(count nothing)
step=$(count step)
fleet=$(count fleet)
scene=$(count scene)
[[ -n $nothing && -n $step && -n $fleet && -n $scene ]] || { echo "valgrind did not count"; exit 1; }
awk -v n="$nothing" -v a="$step" -v f="$fleet" -v b="$scene" -v s="$steps" 'BEGIN {
  plain = (a - n) / s; fleet = (f - n) / s; scene = (b - n) / s
  printf "instructions a step: advance() of a rigid body %.1f; in a scene of 100 without models %.1f, ratio %.3f; ", plain, fleet, fleet / plain
  printf "of one alone, the beat of the fleet on it, %.1f, ratio %.3f\n", scene, scene / plain
  exit !(fleet <= 1.02 * plain && scene <= 1.02 * plain)
}'
