#!/usr/bin/env bash
# In the root that booted.sh has booted: adstar@demo is started, killed, stopped by its watchdog, upgraded under, purged.
set -euo pipefail
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive
source /packages/proof.sh
fail() { echo "booted_inside.sh: FAILED: $*"; exit 1; }
get() { apt-get -y -qq --no-install-recommends -o Dpkg::Options::=--force-confold "$@" > /packages/apt 2>&1 || fail "apt-get $*: $(tail -n 20 /packages/apt)"; }
journal() { journalctl --no-pager --output cat -u adstar@demo; }
pid_of() { systemctl show --property MainPID --value adstar@demo; }
listed() { adstar list --timeout 1s 2> /dev/null | grep -q ": running"; }
another() { local now; now=$(pid_of) && [[ "$now" != 0 && "$now" != "$1" ]] && listed; }

get install /packages/first/*.deb
[[ "$(systemctl is-active adstar@demo adstar-dashboard || true)" == $'inactive\ninactive' ]] || fail "installing has started something"
systemctl enable --now --quiet adstar@demo || fail "start: $(journal | tail -n 20)"
await 20 "the daemon is on the bus" listed
first=$(pid_of)
[[ "$(stat -c %U "/proc/$first")" == adstar ]] || fail "it runs as $(stat -c %U "/proc/$first")"
proved "adstar@demo flies as adstar: $(systemctl show --property StatusText --value adstar@demo)"
adstar timing --for 2s > /packages/timing 2>&1 || true
force=$(grep -m 1 -o 'in force: .*' /packages/timing) || fail "adstar timing: $(cat /packages/timing)"
if prlimit --rtprio=99:99 true 2> /dev/null; then
  [[ "$force" == *"FIFO yes, memory lock yes"* ]] || fail "its limits do not do: $force"
  proved "$force"
else
  proved "(nobody may raise a limit on this machine: FIFO and locked memory cannot be tried)"
fi

kill -KILL "$first"
await 20 "systemd starts it again" another "$first"
journal | grep -q 'the run goes on at step' || fail "it did not go on with its run"
proved "killed, it is started again: $(journal | grep -m 1 -o 'the run goes on at step.*')"

second=$(pid_of)
kill -STOP "$second"
await 30 "the watchdog" another "$second"
proved "stopped, it is ended by the watchdog and started again"

! systemctl start adstar@none 2> /dev/null || fail "a unit without a scene has started"
restarts() { systemctl show --property NRestarts --value "$1"; }
tried_once() { systemctl is-failed --quiet "$1" && [[ "$(systemctl show --property ExecMainStatus --value "$1")" == "$2" ]]; }
tried_once adstar@none 2 || fail "a unit without a scene: $(systemctl status adstar@none)"
[[ "$(restarts adstar@none)" == 0 ]] || fail "what cannot fly was tried again $(restarts adstar@none) times"
proved "a unit without a scene fails once: $(journalctl --no-pager --output cat -u adstar@none | grep -m 1 -o '/etc/adstar/none.toml.*')"

echo '# edited' >> /etc/adstar/demo.toml
systemctl restart adstar@demo
await 20 "the daemon is on the bus" listed
[[ "$(journalctl --no-pager --output cat --priority warning -u adstar@demo)" == *"is not what /var/lib/adstar/demo began with"* ]] ||
  fail "the edited scene is no warning in the journal"
proved "an edited scene is a warning in the journal"

systemctl start adstar-dashboard || fail "the dashboard"
metrics() { { exec 3<> /dev/tcp/127.0.0.1/8765 && printf 'GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:8765\r\nConnection: close\r\n\r\n' >&3 && cat <&3; } 2> /dev/null > /packages/metrics; grep -q '^adstar_up{.*} 1' /packages/metrics; }
await 20 "metrics" metrics
page=$(systemctl show --property MainPID --value adstar-dashboard)
flies=$(pid_of)
get install /packages/second/*.deb
[[ "$(pid_of)" == "$flies" ]] || fail "the upgrade restarted what flies"
grep -q "adstar@demo.service flies on with version" /packages/apt || fail "the upgrade does not name what flies on: $(cat /packages/apt)"
[[ "$(systemctl show --property MainPID --value adstar-dashboard)" != "$page" ]] || fail "the dashboard is the old one"
proved "upgraded: $(grep -o 'adstar@demo.service flies on.*' /packages/apt); the dashboard is restarted"
systemctl restart adstar@demo
await 20 "the daemon is on the bus" another "$flies"
proved "restarted, the new version goes on with the run"

get purge adstar adstar-dashboard libadstar-dev
[[ "$(systemctl is-active adstar@demo || true)" != active && -z "$(pgrep 'adstar' || true)" ]] || fail "it flies after the purge"
left=$(find / -xdev -name '*adstar*' -not -path '/packages/*' -not -path '/proc/*' -not -path '/var/cache/*' -not -path '/var/log/*' -not -path '/var/lib/systemd/*')
[[ -z "$left" && -z "$(ls /dev/shm)" ]] || fail "left: $left $(ls /dev/shm)"
proved "purged: it was ended, and nothing of it is left"
echo "all of it"
