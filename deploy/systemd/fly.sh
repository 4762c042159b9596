#!/bin/sh
# What adstard@NAME.service runs, and the container: goes on with the run of the scene where there is one, and begins it where there
# is none. With ADSTAR_ROLE=standby (standby.conf) it follows the daemon that flies the scene elsewhere, in a new run each time.
#   fly NAME        the directories are those that systemd names: /etc/adstar, /var/lib/adstar, and /run/adstar, where there is one
scene=$CONFIGURATION_DIRECTORY/$1.toml
run=$STATE_DIRECTORY/$1
adstard=${ADSTARD:-/usr/bin/adstard}  # not by the path: /usr/local/bin, with a build of one's own, comes first there
set -- ${RUNTIME_DIRECTORY:+--memory "$RUNTIME_DIRECTORY"}

if [ "${ADSTAR_ROLE:-primary}" = standby ]; then
  exec "$adstard" "$scene" --standby --run "$run.standby-${INVOCATION_ID:-$(cat /proc/sys/kernel/random/uuid)}" "$@"
fi
if [ ! -e "$run/run.json" ]; then
  exec "$adstard" "$scene" --run "$run" "$@"
fi
if [ ! -e "$scene" ]; then
  echo "<4>$scene is missing: the run goes on with its own scene, $run/scene.toml" >&2
elif ! cmp -s "$scene" "$run/scene.toml"; then
  echo "<4>$scene is not what $run began with: the run goes on with its own scene. To fly the new one: stop, rm -r $run, start" >&2
fi
exec "$adstard" --resume "$run" "$@"
