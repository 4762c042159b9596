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
[[ "$(in_store inspect --format '{{.OCIv1.Config.Entrypoint}} {{.OCIv1.Config.Cmd}}' localhost/adstar)" == \
  "[/usr/bin/adstard] [/etc/adstar/demo.toml]" ]] || fail "entry point"
in_store run "$container" -- /usr/bin/adstard /etc/adstar/demo.toml --duration 2s --service boxed > "$work/log" 2>&1 || fail "adstard"
grep -q '2000 steps of 1ms' "$work/log" || fail "it took other steps"
proved "it flies the demo as $user: $(grep -o '2000 steps.*' "$work/log")"
