#!/usr/bin/env bash
# deploy/Containerfile, built and run with buildah in its chroot isolation, which needs neither a container engine nor user
# namespaces. The base is a debootstrap of bookworm in place of debian:12-slim. Some minutes; needs root, buildah, debootstrap
# and apt's own registry.
#   bash tests/package/container.sh [build/release] [a bare root instead of making one]
# Builds nothing: cmake --build build/release --target packages
set -euo pipefail
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot

packages=$(cd "${1:-build/release}/packages" && pwd)
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for tool in buildah debootstrap; do
  command -v $tool > /dev/null || { echo "container.sh: SKIPPED: $tool is missing: apt-get install buildah debootstrap" >&2; exit 77; }
done

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
source "$source/tests/support/proof.sh"
fail() { echo "container.sh: FAILED: $*" >&2; cat "$work/log" >&2; exit 1; }
in_store() { buildah --root "$work/store" --runroot "$work/run" "$@"; }

bare=${2:-}
if [[ -z "$bare" ]]; then
  bare=$work/bare
  debootstrap --variant=minbase bookworm "$bare" > "$work/log" 2>&1 || fail "debootstrap"
fi
container=$(in_store from scratch)
in_store add --quiet "$container" "$bare" / > /dev/null
in_store commit --quiet "$container" localhost/bookworm > /dev/null
in_store build --build-arg BASE=localhost/bookworm --file "$source/deploy/Containerfile" --tag adstar "$packages" > "$work/log" 2>&1 ||
  fail "the build"
proved "the image is made of $(ls "$packages" | grep '^adstar_')"

container=$(in_store from localhost/adstar)
user=$(in_store run "$container" -- id -un)
[[ "$user" == adstar ]] || fail "it runs as $user"
in_store run "$container" -- adstar check configs/scenes/demo.toml > "$work/log" 2>&1 || fail "adstar check"
in_store inspect --format '{{range .OCIv1.Config.Entrypoint}}{{println .}}{{end}}{{range .OCIv1.Config.Cmd}}{{println .}}{{end}}' localhost/adstar > "$work/command"
mapfile -t command < <(grep . "$work/command")
fly() { in_store run "$@" "$container" -- "${command[@]}" > "$work/log" 2>&1; }  # what `podman run` would start, with its options

# The demo, but that it ends.
mkdir "$work/plain"
sed -e 's/^duration = "endless"/duration = "2s"/' -e 's/^\[dds\]/&\ndomain = 79/' "$source/configs/scenes/demo.toml" > "$work/plain/demo.toml"
chmod -R go+rX "$work" "$work/plain"
fly --volume "$work/plain:/etc/adstar:ro" || fail "${command[*]}"
grep -q '2000 steps of 1ms' "$work/log" || fail "it took other steps"
proved "'${command[*]}' flies the demo as $user: $(grep -o '2000 steps.*' "$work/log")"

# As deploy/README.md has it, with keys, which are root's and a group's. buildah has no --group-add: the group is the one it runs under.
keys=4242
mkdir "$work/secured"
bash "$source/deploy/security/make.sh" "$work/keys" > /dev/null
cp -r "$work/keys/daemon" "$work/secured/keys"
chown -R root:$keys "$work/secured/keys" && chmod -R u=rwX,g=rX,o= "$work/secured/keys"
{
  cat "$work/plain/demo.toml"
  sed -n '/^\[dds.security\]/,/^$/s/keys\/daemon/keys/p; /^\[dds.security\]/p' "$source/deploy/scenes/two_machines.toml"
} > "$work/secured/demo.toml"
container=$(in_store from localhost/adstar)  # the other one has a run of its own where these are mounted
install -d -o "$(in_store run "$container" -- id -u)" -m 700 "$work/runs"
mine=(--volume "$work/runs:/var/lib/adstar" --volume "$work/secured:/etc/adstar:ro")  # buildah 1.28 mounts over a VOLUME what comes first alone
! fly "${mine[@]}" || fail "$user has read keys that are neither its own nor its group's"
grep -q 'private_key: got .*cannot be read' "$work/log" || fail "somebody else's keys"
fly --user $user:$keys "${mine[@]}" || fail "in the group of the keys"
grep -q '2000 steps of 1ms' "$work/log" || fail "it took other steps"
fly --user $user:$keys "${mine[@]}" || fail "the second time"
grep -q 'the run goes on at step 2000' "$work/log" || fail "it did not go on"
proved "with keys, in their group, it flies, and the next container goes on: $(grep -o 'the run goes on at step.*' "$work/log")"
