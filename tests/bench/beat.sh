#!/usr/bin/env bash
# How well is the beat kept, beside what this machine can do at all? Blocks of adstard at 1 kHz alternate with blocks of
# cyclictest (Debian's rt-tests) and of beat_control, which spins for 0.05 ms of each beat (a quarter as long), at the same priority and interval on the same processor.
# Prints each block's wake-up lateness p99.9, and the medians over the blocks; how many beats were late after work of adstard's own, and how many
# of the control's spins took more than a beat: the machine alone does that.
#   bash tests/bench/beat.sh [build/release] [blocks] [seconds a block] [spacecraft]
# Needs root, or the capabilities of README.md, "Real time".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bin=${1:-build/release} blocks=${2:-10} seconds=${3:-30} spacecraft=${4:-1}
command -v cyclictest >/dev/null || { echo "beat.sh: cyclictest is missing; apt-get install rt-tests" >&2; exit 2; }
control=$bin/tests/bench/beat_control_bench
[[ -x $control ]] || { echo "beat.sh: $control is not built; cmake --build $bin --target beat_control_bench" >&2; exit 2; }
cpu=$(($(nproc) - 1))
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

{
  cat <<TOML
[simulation]
step = "1ms"
[service]
priority = 80
cpu = $cpu
[budget]
admission = "warn"
[dds]
partition = "beat.$$"
TOML
  cat <<TOML
[[spacecraft]]
name = "sat{:05}"
count = $spacecraft
seed = 1
inertia_body_kg_m2 = [0.9144, 1.098, 1.66]
angular_velocity_body_rad_s = [0.45549, 0.82623, 0.03476]
TOML
  if [[ $spacecraft != 1 ]]; then
    cat <<TOML
[telemetry]
attitude_hz = 0
momentum_hz = 0
fleet_hz = 10
TOML
  fi
} > "$scratch/scene.toml"

# The lateness below which 99.9 % of cyclictest's wake-ups lie [us], from its histogram.
cyclictest_block() {
  cyclictest --quiet --mlockall --priority 80 --interval 1000 --threads 1 --affinity "$cpu" --duration "$seconds" \
    --histogram 50000 --policy fifo > "$scratch/cyclictest"
  awk '/^[0-9]/ { count[$1 + 0] = $2; total += $2; if ($1 + 0 > last) last = $1 + 0 }
       /Histogram Overflows/ { total += $4 }
       END { for (i = 0; i <= last; ++i) { seen += count[i]; if (seen >= 0.999 * total) { print i; exit } } print last }' \
    "$scratch/cyclictest"
}

adstard_block() {
  "$bin/adstard" "$scratch/scene.toml" --duration "${seconds}s" 2> "$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
  grep -oE 'wake-up lateness .* p99.9 [0-9.]+' "$scratch/log" | grep -oE '[0-9.]+$'
}

median() { sort -g | awk '{ v[NR] = $1 } END { print (NR % 2) ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

echo "1 kHz, $spacecraft spacecraft, $blocks blocks of $seconds s each, processor $cpu, $(uname -r)"
for ((block = 1; block <= blocks; ++block)); do
  theirs=$(cyclictest_block)
  ours=$(adstard_block)
  spun=$("$control" $((seconds / 4 + 1)) 50 | grep -oE '[0-9]+ of them past' | grep -oE '[0-9]+')
  echo "$theirs" >> "$scratch/theirs"
  echo "$ours" >> "$scratch/ours"
  worked=$(grep -oE '[0-9]+ after our own work' "$scratch/log" | grep -oE '[0-9]+')
  own=$((${own:-0} + worked)) machine=$((${machine:-0} + spun))
  printf 'block %2d  lateness p99.9: cyclictest %8.1f us, adstard %8.1f us; spins past a beat: %d; %s; %s; %s; %s\n' "$block" "$theirs" "$ours" "$spun" \
    "$(grep -oE '[0-9]+ beats late .*' "$scratch/log")" "$(grep -oE 'the step p50.*' "$scratch/log")" "$(grep -oE 'the hand-over .*' "$scratch/log")" \
    "$(grep -oE '[0-9]+ page faults.*' "$scratch/log")"
done
theirs=$(median < "$scratch/theirs") ours=$(median < "$scratch/ours")
awk -v a="$theirs" -v b="$ours" 'BEGIN { printf "median over blocks: cyclictest %.1f us, adstard %.1f us, ratio %.2f (aim: at most 1.2)\n", a, b, b / a }'
echo "of $((blocks * seconds * 1000)) beats late after adstard's own work $own; of $((blocks * (seconds / 4 + 1) * 1000)) spins of 0.05 ms longer than a beat $machine"
