# Sourced by tests that are scripts: a line for each thing proved, with the time it took, and waiting for what is to come.
# Whoever sources it has fail(), which says what went wrong and ends.

now_ms() { echo $((${EPOCHREALTIME/[.,]/} / 1000)); }
began_ms=$(now_ms)
proved() { printf '%6d ms  %s\n' $(($(now_ms) - began_ms)) "$*"; }

# await SECONDS WHAT COMMAND...: until the command holds.
await() {
  local deadline=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    ((SECONDS < deadline)) || fail "waited in vain: $what"
    sleep 0.02
  done
}
