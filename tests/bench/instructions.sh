#!/usr/bin/env bash
# Instructions a step of a scene without models, beside those of the plain rigid body; fails past 2 %.
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
scene=$(count scene)
[[ -n $nothing && -n $step && -n $scene ]] || { echo "valgrind did not count"; exit 1; }
awk -v n="$nothing" -v a="$step" -v b="$scene" -v s="$steps" 'BEGIN {
  plain = (a - n) / s; scene = (b - n) / s
  printf "advance() of a rigid body %.1f instructions a step, a scene without models %.1f: ratio %.4f\n",
    plain, scene, scene / plain
  exit !(scene <= 1.02 * plain)
}'
