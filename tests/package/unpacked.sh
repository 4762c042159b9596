#!/usr/bin/env bash
# The packages made from a tree that is built, unpacked into a directory, and looked at there: what must be in them is,
# man pages hold, every scene is good, and a daemon flies from there, with the bridge that it began with although another
# was put in its place.
#   bash tests/package/unpacked.sh [build/release]
# Builds nothing: cmake --build build/release --target adstard adstar-bridge adstar
set -euo pipefail
export LC_ALL=C.UTF-8

build=$(cd "${1:-build/release}" && pwd)
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for tool in help2man lowdown mandoc dpkg-shlibdeps file; do
  command -v $tool > /dev/null ||
    { echo "unpacked.sh: SKIPPED: $tool is missing: apt-get install help2man lowdown mandoc dpkg-dev file" >&2; exit 77; }
done

work=$(mktemp -d)
root=$work/root
daemon=""
clean_up() {
  [[ -z "$daemon" ]] || { kill -KILL "$daemon" 2> /dev/null && wait "$daemon" 2> /dev/null; } || true
  rm -rf "$work"
}
trap clean_up EXIT
source "$source/tests/support/proof.sh"
fail() {
  echo "unpacked.sh: FAILED: $*" >&2
  [[ ! -s "$work/log" ]] || tail -n 40 "$work/log" >&2
  exit 1
}

# Papers and packages of its own, so that those of somebody who makes packages stay as they are.
export ADSTAR_PAPERS=$work/papers
bash "$source/deploy/package/papers.sh" "$build" "$ADSTAR_PAPERS" "$("$build/adstard" --version)" \
  "$(sed -n 's/^ADSTAR_PACKAGE_CONTACT:STRING=//p' "$build/CMakeCache.txt")"
(cd "$build" && cpack -B "$work/making" -D CPACK_OUTPUT_FILE_PREFIX="$work/made") > "$work/cpack" 2>&1 || fail "cpack: $(cat "$work/cpack")"
mkdir "$work/control"
mapfile -t packages < <(ls "$work"/made/*.deb)
[[ ${#packages[@]} == 3 ]] || fail "expected 3 packages, got ${packages[*]}"
for package in "${packages[@]}"; do
  dpkg-deb -x "$package" "$root"
  dpkg-deb -e "$package" "$work/control/$(dpkg-deb -f "$package" Package)"
done
proved "made: $(for package in "${packages[@]}"; do dpkg-deb -f "$package" Package | tr '\n' ' '; done)"

outside=$(cd "$root" && find . -type f -not -path './usr/*' -printf '/%P\n' | sort)
[[ "$outside" == "$(sort "$work"/control/*/conffiles)" ]] || fail "outside /usr, and no setting: $outside"
for name in adstar adstar-dashboard; do
  for script in "$work/control/$name"/p*; do
    sh -n "$script" || fail "$script"
  done
done
for depends in libddsc0debian libc6 systemd-standalone-sysusers; do
  grep -q "^Depends:.*$depends" "$work/control/adstar/control" || fail "adstar does not depend on $depends"
done
version=$(sed -n 's/^Version: //p' "$work/control/adstar/control")
grep -qxF "Depends: adstar (= $version)" "$work/control/adstar-dashboard/control" || fail "the dashboard is of any version"

# What a unit starts is there.
for unit in "$root"/usr/lib/systemd/system/*; do
  mapfile -t programs < <(grep -oE '^ExecStart=[^ ]*' "$unit" | cut -d = -f 2 | sort -u)
  [[ ${#programs[@]} -gt 0 ]] || fail "$unit starts nothing"
  for program in "${programs[@]}"; do
    [[ -x "$root$program" ]] || fail "$unit starts $program, which is not in the package"
  done
done
[[ -f "$root/usr/lib/sysusers.d/adstar.conf" && -f "$root/usr/share/adstar/idl/command.idl" ]] || fail "group or IDL missing"
[[ -f "$root/usr/share/cmake/adstar/adstarConfig.cmake" && -f "$root/usr/include/adstar/propagator.hpp" ]] ||
  fail "libadstar-dev has no headers or no adstarConfig.cmake"
proved "units, settings, headers and IDL are in place, and all that is outside /usr is a setting"

# A page for each verb, and none that a formatter complains of.
share=$root/usr/share
mapfile -t verbs < <("$root/usr/bin/adstar" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
[[ ${#verbs[@]} -gt 20 ]] || fail "adstar --help names ${#verbs[@]} verbs"
for page in man1/adstar man8/adstard man8/adstar-bridge man5/adstar-scene "${verbs[@]/#/man1/adstar-}"; do
  section=${page#man}
  file=$share/man/$page.${section%%/*}.gz
  [[ -e "$file" ]] || fail "$page is missing"
  page=$(basename "${file%.gz}")
  gunzip < "$file" > "$work/$page"
  complaints=$(mandoc -Tlint -Wwarning "$work/$page" || true)
  [[ -z "$complaints" ]] || fail "$page: $complaints"
done
gunzip < "$share/man/man5/adstar-scene.5.gz" | grep -q 'spin_inertia_kg_m2' || fail "adstar-scene(5) has no wheels"
bash -n "$share/bash-completion/completions/adstar" || fail "bash completion"
proved "$((${#verbs[@]} + 4)) man pages, and mandoc finds nothing in them"

# Paths that the programs and the pages of running them name. deploy/package.sh is for a machine that builds.
mapfile -t named < <(grep -aohE '\b(configs|deploy|service|idl|include)/[A-Za-z0-9_./@-]+\.(md|sh|toml|csv|conf|service|xml)\b' \
  "$root"/usr/bin/adstar* "$share"/adstar/deploy/{README.md,security/README.md} | grep -vx deploy/package.sh | sort -u)
[[ ${#named[@]} -gt 15 ]] || fail "only ${#named[@]} paths were found: the pattern is broken"
for path in "${named[@]}"; do
  [[ -f "$share/adstar/$path" ]] || fail "/usr/share/adstar has no $path, which a program or a page names"
done
for page in README.md service/pages/runs.md deploy/README.md; do
  [[ "$share/doc/adstar/$page" -ef "$share/adstar/$page" ]] || fail "/usr/share/doc/adstar/$page does not lead to the page"
done
proved "${#named[@]} paths that programs and pages name are in /usr/share/adstar"

for scene in "$share"/adstar/configs/scenes/*.toml "$root"/etc/adstar/*.toml; do
  "$root/usr/bin/adstar" check "$scene" > "$work/said" 2>&1 || fail "$scene: $(cat "$work/said")"
done
proved "every scene in it passes adstar check"

# ---- it flies; an upgrade comes; the bridge falls -----------------------------------------------------
domain=78
{ grep -v '^interface' "$root/etc/adstar/demo.toml"; printf '[service]\nname = "unpacked"\n'; } |
  sed "s/^\[dds\]/&\ndomain = $domain/" > "$work/scene.toml"
"$root/usr/bin/adstard" "$work/scene.toml" --run "$work/run" 2> "$work/log" &
daemon=$!
listed() { "$root/usr/bin/adstar" list --domain $domain --timeout 1s 2> /dev/null | grep -q "^service 'unpacked': running"; }
await 20 "the daemon is on the bus" listed
heard=$("$root/usr/bin/adstar" monitor sat1 --domain $domain --for 1s --format csv | grep -c '^sat1\|,sat1,' || true)
((heard > 3)) || fail "monitor heard $heard samples of sat1 in a second"
proved "it flies, and adstar monitor hears $heard samples in a second"

cp /bin/false "$work/other" && mv "$work/other" "$root/usr/bin/adstar-bridge"
bridge() { pgrep -P "$daemon" -x adstar-bridge; }
first=$(bridge) || fail "the bridge is not known by its name"
kill -KILL "$first"
another() { local now; now=$(bridge) && [[ "$now" != "$first" ]]; }
await 10 "another bridge" another
await 20 "the daemon is on the bus again" listed
proved "the bridge falls after an upgrade, and the daemon starts the one that it began with"
kill -INT "$daemon"
code=0
wait "$daemon" || code=$?
daemon=""
[[ $code == 0 ]] || fail "the daemon ended with exit code $code"
