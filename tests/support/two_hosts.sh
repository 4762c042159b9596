# Sourced by tests that are scripts, after proof.sh: hosts that are network namespaces, a wire between two of them, and daemons
# on them that are ended when the script ends. Whoever sources it has `hosts`, their names, and `wire`, what both ends of it are called.

declare -A pid  # of the daemons that were not waited for yet

netns() { echo "adstar-$$-$1"; }
on() { ip netns exec "$(netns "$1")" "${@:2}"; }  # host, command; not in the background, where the shell would stand between

make_wire() {
  local host number=0
  for host in "${hosts[@]}"; do
    ip netns add "$(netns "$host")" && on "$host" true || return
  done
  ip link add "$wire" netns "$(netns "${hosts[0]}")" type veth peer name "$wire" netns "$(netns "${hosts[1]}")" || return
  for host in "${hosts[@]}"; do
    ip -n "$(netns "$host")" address add "10.77.0.$((++number))/24" dev "$wire" &&
      ip -n "$(netns "$host")" link set lo up && ip -n "$(netns "$host")" link set "$wire" up || return
  done
}

remove_wire() {
  local host
  for host in "${hosts[@]}"; do
    ip netns del "$(netns "$host")" 2> /dev/null || true  # and the veth pair with it
  done
}

skip_without_wire() {  # name of the script
  local said
  if ! said=$(make_wire 2>&1); then
    remove_wire
    echo "$1: SKIPPED: no network namespaces can be made here (root and iproute2 are needed): $(tail -n 1 <<< "$said")" >&2
    exit 77
  fi
  remove_wire
}

# By its number alone it might be somebody else by now: only the shell knows.
flying() { [[ -n "${pid[$1]:-}" ]] && grep -qx "${pid[$1]}" <<< "$(jobs -pr)"; }
ended() { ! flying "$1"; }

ends_with() {  # daemon, exit code
  await 15 "the $1 ends" ended "$1"
  local code=0
  wait "${pid[$1]}" || code=$?
  unset "pid[$1]"
  [[ $code == "$2" ]] || fail "the $1 ended with exit code $code, not $2"
}

# In good order, so that nothing is left in shared memory; the bridges end with their daemons.
end_daemons() {
  local daemon deadline=$((SECONDS + 10))
  for daemon in "${!pid[@]}"; do
    ended "$daemon" || kill -INT "${pid[$daemon]}" || true
  done
  for daemon in "${!pid[@]}"; do
    while flying "$daemon" && ((SECONDS < deadline)); do sleep 0.02; done
    ended "$daemon" || kill -KILL "${pid[$daemon]}" || true
    wait "${pid[$daemon]}" || true
  done
}
trap 'exit 130' INT
trap 'exit 143' TERM
