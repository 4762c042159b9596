#!/usr/bin/env bash
# In the root that booted.sh has booted: adstard@demo is started, killed, stopped by its watchdog, upgraded under, purged; adstard@two
# stands by for adstard@one and takes over. What deploy/README.md has somebody type is typed as it says.
set -euo pipefail
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive APT_CONFIG=/packages/apt.conf
source /packages/proof.sh
source /packages/typed.sh
fail() { echo "booted_inside.sh: FAILED: $*" >&2; exit 1; }
as_said() {  # section of deploy/README.md, which lines, what to put for its names
  local lines
  lines=$(typed /packages/README.md "$1" "$2" | sed -e "${3:-}")
  bash -ec "$lines" > /packages/log 2>&1 || fail "$lines: $(tail -n 20 /packages/log)"
}
journal() { journalctl --no-pager --output cat -u "adstard@$1"; }
says() { journal "$1" | grep "$2" > /dev/null; }
is() { systemctl show --property "$2" --value "$1"; }  # unit, what
pid_of() { is "adstard@$1" MainPID; }
listed() { adstar list --timeout 1s 2> /dev/null | grep "^service '$1': running" > /dev/null; }
another() { local now; now=$(pid_of demo) && [[ "$now" != 0 && "$now" != "$1" ]] && listed "$name"; }
name=$(uname -n)  # which is what a daemon calls itself
failed_with() { systemctl is-failed --quiet "$1" && [[ "$(is "$1" ExecMainStatus)" == "$2" ]]; }

cd /packages/first
as_said Install "^apt install"
[[ "$(systemctl is-active adstard@demo adstar-dashboard || true)" == $'inactive\ninactive' ]] || fail "installing has started something"
mapfile -t rated < <(sed -n '/^## What the units may do/,/^## /s/^    systemd-analyze .*[^ ]  *# //p' /packages/README.md)
as_said "What the units may do" .
for rating in "${rated[@]}"; do
  grep -q "Overall exposure level.*: $rating" /packages/log || fail "systemd-analyze does not say $rating: $(grep Overall /packages/log)"
done
[[ ${#rated[@]} == 2 ]] || fail "the page rates ${#rated[@]} units"
proved "the units are rated ${rated[*]}"
systemctl enable --now --quiet adstard@demo || fail "start: $(journal demo | tail -n 20)"
await 20 "the daemon is on the bus" listed "$name"
first=$(pid_of demo)
account=$(stat -c %u "/proc/$first")
((account >= 61184 && account <= 65519)) && ! grep ":$account:" /etc/passwd || fail "it runs as $account, which is no dynamic account"
proved "adstard@demo flies as $account: $(systemctl show --property StatusText --value adstard@demo)"
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
says demo 'the run goes on at step' || fail "it did not go on with its run"
proved "killed, it is started again: $(journal demo | grep -m 1 -o 'the run goes on at step.*')"

mkdir -p /run/systemd/system/adstard@demo.service.d
printf '[Service]\nRestart=no\n' > /run/systemd/system/adstard@demo.service.d/fallen.conf
systemctl daemon-reload
kill -KILL "$(pid_of demo)"
await 10 "it has fallen" systemctl is-failed --quiet adstard@demo
[[ "$(ls /run/adstar/)" == adstar-* ]] || fail "what was in memory went with the account: $(ls -R /run/adstar/)"
rm -r /run/systemd/system/adstard@demo.service.d
systemctl daemon-reload
systemctl start adstard@demo
await 20 "it is on the bus again" listed "$name"
! says demo 'is gone' || fail "something was lost"
proved "fallen for good, its account is gone, and what it had in memory is not"

second=$(pid_of demo)
kill -STOP "$second"
await 30 "the watchdog" another "$second"
proved "stopped, it is ended by the watchdog and started again"

! systemctl start adstard@none 2> /dev/null || fail "a unit without a scene has started"
failed_with adstard@none 2 || fail "a unit without a scene: $(systemctl status adstard@none)"
proved "a unit without a scene fails, once: $(journal none | grep -m 1 -o '/etc/adstar/none.toml.*')"

echo '# edited' >> /etc/adstar/demo.toml
systemctl restart adstard@demo
await 20 "the daemon is on the bus" listed "$name"
[[ "$(journalctl --no-pager --output cat --priority warning -u adstard@demo)" == *"is not what /var/lib/adstar/demo began with"* ]] ||
  fail "the edited scene is no warning in the journal"
proved "an edited scene is a warning in the journal"

for unit in one two; do
  sed 's/"sat1"/"paired"/' /usr/share/adstar/configs/scenes/pair.toml > /etc/adstar/$unit.toml
done
systemctl start adstard@one
as_said "A fleet in shards" "standby.conf|daemon-reload" "s/NAME/two/"
systemctl start adstard@two
await 20 "the standby follows" says two "follows from step"
kill -KILL "$(pid_of one)"
await 20 "the standby takes over" says two "the primary is gone"
await 20 "the primary comes back and is refused" failed_with adstard@one 3
[[ "$(is adstard@one NRestarts)" == 1 ]] || fail "the primary was started again $(is adstard@one NRestarts) times, once was enough"
listed pair || fail "nobody flies what the primary flew"
proved "a unit with standby.conf follows and takes over; the primary comes back, is refused, and that is not tried again"

as_said "Two machines" "^cp|make.sh|^mkdir|^chown"
sed -i 's/"eth0"/"lo"/; s/^\[simulation\]/[budget]\nadmission = "warn"\n&/' /etc/adstar/plant.toml  # which is the one wire here
systemctl start adstard@plant || fail "$(journal plant | tail -n 20)"
secured() { adstar list --timeout 1s --domain 7 --security ~/keys/commander 2> /dev/null | grep "^service 'plant': running" > /dev/null; }
await 20 "who has a key hears it" secured
[[ "$(stat -c '%U %a' /etc/adstar/keys/daemon/private_key.pem)" == "root 640" ]] || fail "the key: $(ls -l /etc/adstar/keys/daemon)"
! adstar list --timeout 1s --domain 7 > /dev/null 2>&1 || fail "who has none hears it too"
systemctl stop adstard@plant
proved "with root's keys, read by their group, it flies on a secured bus"

systemctl start adstar-dashboard || fail "the dashboard"
metrics() { { exec 3<> /dev/tcp/127.0.0.1/8765 && printf 'GET /metrics HTTP/1.1\r\nHost: 127.0.0.1:8765\r\nConnection: close\r\n\r\n' >&3 && cat <&3; } 2> /dev/null > /packages/metrics; grep -q '^adstar_up{.*} 1' /packages/metrics; }
await 20 "metrics" metrics
page=$(is adstar-dashboard MainPID)
flies=$(pid_of demo)
cd /packages/second
as_said Upgrades "^apt install"
[[ "$(pid_of demo)" == "$flies" ]] || fail "the upgrade restarted what flies"
grep -q "adstard@demo.service flies on with the program it was started with" /packages/log || fail "the upgrade does not name what flies on: $(cat /packages/log)"
grep -q "adstard@two.service, a standby, .*A restart begins a new standby" /packages/log || fail "the upgrade does not say what a restart of a standby is: $(cat /packages/log)"
[[ "$(is adstar-dashboard MainPID)" != "$page" ]] || fail "the dashboard is the old one"
proved "upgraded, both packages: $(grep -o 'adstard@demo.service flies on.*' /packages/log); the dashboard is restarted"
systemctl restart adstard@demo
await 20 "the daemon is on the bus" another "$flies"
proved "restarted, the new version goes on with the run"
as_said "The one that took over" . "s/NAME/two/g; s/standby-ID/standby-*/"
says two 'the run goes on at step' || fail "the one that took over did not go on: $(journal two | tail -n 20)"
await 20 "the one that took over is back" listed pair
proved "the one that took over is made the primary: $(journal two | grep -m 1 -o 'the run goes on at step.*')"

rm -r /etc/adstar/{one,two,plant}.toml /etc/adstar/keys ~/keys  # somebody's own
rmdir /etc/systemd/system/adstard@two.service.d
apt-get purge adstar adstar-dashboard libadstar-dev > /packages/log 2>&1 || fail "apt-get purge: $(tail -n 20 /packages/log)"
[[ "$(systemctl is-active adstard@demo || true)" != active && -z "$(pgrep 'adstar' || true)" ]] || fail "it flies after the purge"
left=$(find / -xdev -name '*adstar*' -not -path '/packages/*' -not -path '/proc/*' -not -path '/var/cache/*' -not -path '/var/log/*' -not -path '/var/lib/systemd/*')
left+=$(find /run /dev/shm -name '*adstar*')
[[ -z "$left" ]] || fail "left: $left"
proved "purged: it was ended, and nothing of it is left"
echo "all of it"
