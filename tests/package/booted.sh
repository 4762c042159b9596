#!/usr/bin/env bash
# The units under a systemd that runs: a bare Debian 12 (debootstrap) with systemd, booted by systemd-nspawn with no network but
# loopback; booted_inside.sh is what happens in it. Some minutes; needs root, debootstrap, systemd-container and apt's own registry.
#   bash tests/package/booted.sh [build/release] [a bare root to copy instead of making one]
# Builds nothing: cmake --build build/release --target packages
set -euo pipefail
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive

build=$(cd "${1:-build/release}" && pwd)
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$source/tests/support/proof.sh"
source "$source/tests/package/roots.sh"
missing_tools booted.sh systemd-nspawn
work=$(mktemp -d)
root=$work/root
trap 'rm -rf --one-file-system "$work"' EXIT
fail() {
  echo "booted.sh: FAILED: $*" >&2
  for log in "$work"/*.log "$root/packages/journal"; do
    [[ ! -s "$log" ]] || { echo "---- $log" >&2; tail -n 40 "$log" >&2; }
  done
  exit 1
}

make_two_versions
apt_settings
make_root "$root" "${2:-}"
cp -r "$work/debs/." "$source"/tests/support/{proof,typed}.sh "$source/tests/package/booted_inside.sh" "$source/deploy/README.md" "$root/packages/"
# What the packages depend on is brought now: inside there is no network.
chroot "$root" sh -c 'apt-get -y -qq update && apt-get -y -qq --no-install-recommends install systemd systemd-sysv dbus procps openssl &&
  apt-get -y -qq --no-install-recommends --download-only install /packages/first/*.deb' > "$work/apt.log" 2>&1 || fail "systemd in the root"
cat > "$root/etc/systemd/system/tried.service" <<'UNIT'
[Unit]
After=dbus.service
[Service]
Type=oneshot
ExecStart=/bin/bash /packages/booted_inside.sh
ExecStopPost=/bin/sh -c 'journalctl --no-pager -u "adstar*" > /packages/journal; systemctl --no-block poweroff'
StandardOutput=append:/packages/said
StandardError=append:/packages/said
UNIT
mkdir -p "$root/etc/systemd/system/multi-user.target.wants"
ln -s ../tried.service "$root/etc/systemd/system/multi-user.target.wants/tried.service"
proved "a bare Debian $(cat "$root/etc/debian_version") with systemd"

# What a machine lets its units do and a container its own not: FIFO, and memory that stays.
timeout 300 systemd-nspawn --quiet --register=no --keep-unit --private-network \
  --capability=CAP_SYS_NICE,CAP_IPC_LOCK,CAP_SYS_RESOURCE --system-call-filter="@memlock @resources" --directory "$root" --boot --pipe \
  < /dev/null > "$work/boot.log" 2>&1 || true
cat "$root/packages/said"
[[ "$(tail -n 1 "$root/packages/said")" == *"all of it" ]] || fail "it did not come to its end"
