#!/usr/bin/env bash
# Installs what the tests need, builds, and runs them: all in release, then what the sanitizers can judge.
#   bash tests/run.sh            everything, but for the schemes' own tests under asan
#   bash tests/run.sh --long     those too: some twenty minutes more
#   bash tests/run.sh --quick    release only
set -euo pipefail

quick=false
numerics=OFF
case "${1:-}" in
  "") ;;
  --quick) quick=true ;;
  --long) numerics=ON ;;
  *)
    echo "usage: bash tests/run.sh [--quick | --long]" >&2
    exit 2
    ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash deploy/install-deps.sh --tests

jobs=$(nproc)
summary=()
failed=false

# judge NAME COMMAND...: runs it, notes how it ended and how long it took, goes on either way.
judge() {
  local name=$1 began=$SECONDS outcome=passed
  shift
  echo
  echo "==== $name"
  "$@" || outcome=FAILED
  [[ $outcome == passed ]] || failed=true
  summary+=("$(printf '%-28s %-7s %5d s' "$name" "$outcome" $((SECONDS - began)))")
  [[ $outcome == passed ]]
}

# ThreadSanitizer of this age cannot place its shadow when the kernel spreads mappings far.
without_randomisation() {
  if setarch "$(uname -m)" -R true 2>/dev/null; then
    setarch "$(uname -m)" -R "$@"
  else
    "$@"
  fi
}

configure() {
  judge "$1: configure" cmake --preset "$1" -DADSTAR_BUILD_TESTS=ON -DADSTAR_SANITIZE_NUMERICS="$numerics"
}
build() { judge "$1: build" cmake --build "build/$1" --parallel "$jobs" --target "$2"; }
run_tests() {
  judge "$1: tests" without_randomisation \
    ctest --test-dir "build/$1" --parallel "$jobs" --output-on-failure --no-tests=error
}

configure release && build release all && built=true || built=false

if [[ $quick == true ]]; then
  [[ $built == false ]] || run_tests release || true
else
  # Many tests wait for a clock and leave the processor idle: what it has left goes to the sanitizers' builds.
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  (
    for preset in asan tsan; do
      configure $preset && build $preset adstar_tests || exit 1
    done
  ) < /dev/null > "$log" 2>&1 &
  sanitized=$!
  renice -n 19 -p "$sanitized" > /dev/null || true
  [[ $built == false ]] || run_tests release || true
  judge "sanitizers: build, the rest" wait "$sanitized" || tail -n 100 "$log"
  export ASAN_OPTIONS=detect_stack_use_after_return=1
  export UBSAN_OPTIONS=print_stacktrace=1
  export TSAN_OPTIONS=second_deadlock_stack=1
  run_tests asan || true
  run_tests tsan || true
fi

echo
echo "==== summary"
printf '%s\n' "${summary[@]}"
if [[ $failed == true ]]; then
  echo "adstar tests: FAILED"
  exit 1
fi
echo "adstar tests: all passed"
