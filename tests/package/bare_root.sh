#!/usr/bin/env bash
# The packages on a bare Debian 12: debootstrap (minbase) into a directory, and there, in a chroot: installed with what they
# depend on, run, upgraded while a run flies, removed, purged. Afterwards every path is as before. Some minutes; needs root,
# debootstrap, iproute2 and apt's own registry. The daemons fly in a network namespace of their own.
#   bash tests/package/bare_root.sh [build/release] [a bare root to copy instead of making one]
# Builds nothing: cmake --build build/release --target packages
set -euo pipefail
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive

build=$(cd "${1:-build/release}" && pwd)
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$source/tests/support/proof.sh"
source "$source/tests/support/typed.sh"
source "$source/tests/package/roots.sh"
missing_tools bare_root.sh ip

# Mounts and daemons of its own: all of them go when it ends.
if [[ "${ADSTAR_BARE_ROOT:-}" != apart ]]; then
  ADSTAR_BARE_ROOT=apart exec unshare --mount --pid --fork --mount-proc --kill-child "$0" "$@"
fi

work=$(mktemp -d)
root=$work/root
netns=adstar-bare-$$
clean_up() {
  [[ -z "$(jobs -pr)" ]] || kill -INT $(jobs -pr) 2> /dev/null || true
  wait || true
  ip netns del "$netns" 2> /dev/null || true
  umount -R "$root/proc" "$root/dev/shm" "$root/run" "$root/packages" 2> /dev/null || true
  rm -rf --one-file-system "$work"
}
trap clean_up EXIT
fail() {
  echo "bare_root.sh: FAILED: $*" >&2
  for log in "$work"/*.log; do
    [[ ! -s "$log" ]] || { echo "---- $log" >&2; tail -n 20 "$log" >&2; }
  done
  exit 1
}

make_two_versions
apt_settings
make_root "$root" "${2:-}"
mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
mount -t tmpfs -o mode=755 tmpfs "$root/run"
mount --bind "$work/debs" "$root/packages"

ip netns add "$netns" || fail "a network namespace"
ip -n "$netns" link set lo up
inside() { chroot "$root" env APT_CONFIG=/packages/apt.conf "$@"; }
account=61184  # as systemd makes one for the unit
flying() { ip netns exec "$netns" chroot --userspec=$account:$account "$root" "$@"; }  # on a wire of its own
get() { inside apt-get "$@" >> "$work/apt.log" 2>&1 || fail "apt-get $*"; }
as_said() {  # section of deploy/README.md, directory of packages
  local lines
  lines=$(typed "$source/deploy/README.md" "$1" "^apt install")
  inside bash -ec "cd /packages/$2; $lines" >> "$work/apt.log" 2>&1 || fail "$lines"
}

paths() { (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./packages -o -path ./var/cache -o -path ./var/log \
  -o -path ./var/lib/apt -o -path ./tmp \) -prune -o -print | sort); }
get update
paths > "$work/before"
cp "$root"/etc/{passwd,group} "$work/"
proved "a bare Debian $(cat "$root/etc/debian_version") of $(inside dpkg-query -f '.\n' -W | wc -l) packages"

# ---- installed ----------------------------------------------------------------------------------------
as_said Install first
version() { inside dpkg-query -f '${db:Status-Status} ${Version}' -W "$1"; }
[[ "$(version adstar)" == "installed "*-1 ]] || fail "adstar is $(version adstar)"
proved "installed: adstar, adstar-dashboard, libadstar-dev, and what they depend on"
for scene in "$root"/usr/share/adstar/configs/scenes/*.toml; do
  inside adstar check "${scene#"$root"}" > "$work/check.log" 2>&1 || fail "adstar check ${scene#"$root"}"
done
inside adstar propagate /usr/share/adstar/configs/scenes/paper_free.toml --every 10s > "$work/rows" || fail "adstar propagate"
[[ $(wc -l < "$work/rows") -gt 5 ]] || fail "adstar propagate printed $(wc -l < "$work/rows") lines"
proved "adstar checks every scene that came with it, and propagates"

# ---- it flies -----------------------------------------------------------------------------------------
printf '\n[service]\nname = "mine"  # a change of somebody\n' >> "$root/etc/adstar/demo.toml"
install -d -o $account -g $account -m 700 "$root/var/lib/adstar" "$root/run/adstar"  # as StateDirectory= and RuntimeDirectory= do
unit() { flying env CONFIGURATION_DIRECTORY=/etc/adstar STATE_DIRECTORY=/var/lib/adstar RUNTIME_DIRECTORY=/run/adstar /usr/lib/adstar/fly "$1"; }
unit demo 2> "$work/adstard.log" &
listed() { flying adstar list --timeout 1s 2> /dev/null | grep -q "^service 'mine': running"; }
await 30 "the daemon is on the bus" listed
samples() { flying adstar monitor sat1 --for 2s --format csv 2> /dev/null | grep -c sat1 || true; }
heard=$(samples)
((heard > 10)) || fail "adstar monitor heard $heard samples in 2 s"
proved "what adstard@demo starts flies /etc/adstar/demo.toml as an account of no name; adstar monitor hears $heard samples in 2 s"
flying adstar torque sat1 --torque-n-m 0 0 0.05 --for 100ms > "$work/verdict.log" 2>&1 || fail "a command"
proved "it obeys: $(head -n 1 "$work/verdict.log")"

flying adstar dashboard --port 8765 > "$work/dashboard.log" 2>&1 &
metrics() {
  flying bash -c 'exec 3<> /dev/tcp/127.0.0.1/8765 && printf "GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:8765\r\nConnection: close\r\n\r\n" >&3 &&
    cat <&3' 2> /dev/null > "$work/metrics"
  grep -q '^adstar_up{.*} 1' "$work/metrics"
}
await 20 "metrics of the dashboard" metrics
proved "adstar dashboard: $(grep -m 1 '^adstar_up' "$work/metrics")"

# ---- upgraded while it flies --------------------------------------------------------------------------
child() { pgrep -x adstard; }
before=$(child)
bridge=$(pgrep -P "$before" -x adstar-bridge)
as_said Upgrades second
[[ "$(version adstar)" == "installed "*-2 && "$(version adstar-dashboard)" == "installed "*-2 ]] || fail "not upgraded"
[[ "$(child)" == "$before" && "$(readlink "/proc/$before/exe")" == *"(deleted)" ]] || fail "the upgrade touched the daemon"
listed || fail "the daemon is off the bus after the upgrade"
proved "upgraded to $(version adstar | cut -d ' ' -f 2): the daemon that flies is the one of before"
grep -q 'a change of somebody' "$root/etc/adstar/demo.toml" || fail "the changed setting was overwritten"
[[ -f "$root/etc/adstar/demo.toml.dpkg-dist" ]] || fail "the newer setting was not laid beside"
proved "/etc/adstar/demo.toml has kept its change; the packaged one is beside it"
kill -KILL "$bridge"
another() { local now; now=$(pgrep -P "$before" -x adstar-bridge) && [[ "$now" != "$bridge" ]]; }
await 10 "another bridge" another
await 20 "the daemon is on the bus again" listed
proved "its bridge falls: the next one is of its own version too"

kill -INT "$before"
gone() { ! child > /dev/null; }
await 20 "the daemon ends" gone
: > "$work/resumed.log"
unit demo 2> "$work/resumed.log" &
await 30 "the run goes on" grep -q 'the run goes on at step' "$work/resumed.log"
await 30 "the daemon is on the bus" listed
kill -KILL "$(child)"
[[ "$(ls "$root/run/adstar")" == adstar-* ]] || fail "it has left nothing in /run/adstar for the purge"
kill -INT "$(pgrep -x adstar)"
await 20 "the daemon ends" gone
proved "the new version goes on with the run: $(grep -o 'the run goes on at step.*' "$work/resumed.log")"
wait

# ---- removed, purged ----------------------------------------------------------------------------------
get remove adstar
[[ -f "$root/etc/adstar/demo.toml" && -f "$root/var/lib/adstar/demo/run.json" && ! -e "$root/usr/bin/adstard" ]] ||
  fail "remove took settings or runs, or left programs"
proved "removed: settings and runs are kept"
echo 'mine = 1' > "$root/etc/adstar/other.toml"
get purge adstar adstar-dashboard libadstar-dev
[[ -f "$root/etc/adstar/other.toml" ]] || fail "purge took a scene that is not the package's"
rm -r "$root/etc/adstar"
get autoremove --purge
paths > "$work/after"
# The files of accounts keep a copy of what they were before.
left=$(diff "$work/before" "$work/after" | grep '^[<>]' | grep -vE '^> \./etc/(passwd|shadow|group|gshadow)-$' || true)
[[ -z "$left" ]] || fail "other paths than before: $left"
others=$({ diff "$work/passwd" "$root/etc/passwd"; diff "$work/group" "$root/etc/group"; } | grep '^[<>]' || true)
[[ "$others" == "> adstar-keys:"* && "$others" != *$'\n'* ]] || fail "accounts: $others"
in_memory=$(find "$root/dev/shm" "$root/run" -mindepth 1)
[[ -z "$in_memory" ]] || fail "left in memory: $in_memory"
proved "purged: every path is as before; what stays is the group of keys"
