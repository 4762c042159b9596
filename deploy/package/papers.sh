#!/usr/bin/env bash
# What a package has on paper, made from what there is: man pages of the options from the programs' own help, adstar-scene(5)
# from the pages on scenes, bash completion, changelogs, documents.
#   bash deploy/package/papers.sh BUILD OUTPUT VERSION CONTACT      BUILD has adstar and adstard; OUTPUT is made anew
set -euo pipefail
export LC_ALL=C.UTF-8 TZ=UTC

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$(cd "$here/../.." && pwd)
build=$1
output=$2
version=$3
contact=$4

for tool in help2man lowdown; do
  command -v $tool > /dev/null || { echo "papers.sh: $tool is missing: apt-get install help2man lowdown" >&2; exit 1; }
done

# The same tree gives the same bytes: every date is that of the last commit, or of the changelog.
if [[ -z "${SOURCE_DATE_EPOCH:-}" ]]; then
  SOURCE_DATE_EPOCH=$(git -C "$source" log -1 --format=%ct 2> /dev/null || stat -c %Y "$source/CHANGELOG.md")
fi
export SOURCE_DATE_EPOCH
day=$(date -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%d)
month=$(date -d "@$SOURCE_DATE_EPOCH" "+%B %Y")

rm -rf "$output"
mkdir -p "$output"/adstar/{man/man1,man/man5,man/man8,bash-completion/completions}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

manual() {  # program, section, what it is in a line, more sections
  local extra=()
  [[ -z "${4:-}" ]] || extra=(--include "$4")
  # Examples stand a line each.
  help2man --no-info --section "$2" --manual adstar --source "adstar $version" --version-string "$1 $version" \
    --name "$3" "${extra[@]}" "$work/$1" |
    sed -e "s/\"$month\"/\"$day\"/" -e '/^\.IP$/,/^\.[PST]/s/^[^.]/.br\n&/' > "$output/adstar/man/man$2/$1.$2"
}

# help2man calls a page by the name of the program: those of the verbs get names of their own.
ln -s "$build/adstard" "$work/adstard"
ln -s "$build/adstar" "$work/adstar"
"$build/adstar" --help > "$work/help"
mapfile -t verbs < <(sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]*\) .*/\1/p' "$work/help")
{
  echo '[SEE ALSO]'
  for verb in "${verbs[@]}"; do
    printf '.BR adstar-%s (1),\n' "$verb"
  done
  printf '.BR adstar-scene (5),\n.BR adstard (8)\n\n[FILES]\n'
  cat "$here/man/files.roff"
} > "$work/adstar.h2m"
what=$(head -n 1 "$work/help")
manual adstar 1 "${what,}" "$work/adstar.h2m"
for verb in "${verbs[@]}"; do
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$build/adstar" "$verb" > "$work/adstar-$verb"
  chmod +x "$work/adstar-$verb"
  what=$("$build/adstar" "$verb" --help | head -n 1)
  manual "adstar-$verb" 1 "$what"
done
cat "$here/man/adstard.h2m" "$here/man/files.roff" > "$work/adstard.h2m"
manual adstard 8 "flies the spacecraft of a scene in real time" "$work/adstard.h2m"
ln -s adstard.8.gz "$output/adstar/man/man8/adstar-bridge.8.gz"

# Sections of service/pages about keys follow the page on scenes.
section() { cat "$source"/service/pages/*.md | sed -n "/^##\? $1\$/,/^##\? /{/^##\? $1\$/p;/^##\? /!p}"; }
{
  printf '# Name\nadstar-scene - what adstard flies: the keys of a scene\n\n# Description\n'
  tail -n +2 "$source/service/scene/README.md"
  for name in "One beat" Wheels "Orbit, and the space around" "Linked bodies" "A run on disk" "Hot standby" "ROS 2"; do
    section "$name" > "$work/section"
    [[ -s "$work/section" ]] || { echo "papers.sh: service/pages has no section '$name'" >&2; exit 1; }
    echo
    cat "$work/section"
  done
  printf '# See also\n**adstard**(8), **adstar-check**(1), **adstar**(1)\n'
} | sed 's/^## /# /' | awk -f "$here/man/tables_as_lists.awk" |
  lowdown -s -tman --parse-no-intraemph --out-no-smarty --nroff-nolinks -m title=ADSTAR-SCENE -m section=5 -m date="$day" \
    -m source="adstar $version" -m volume=adstar |
  awk -f "$here/man/plain_man.awk" > "$output/adstar/man/man5/adstar-scene.5"

"$build/adstar" completion bash > "$output/adstar/bash-completion/completions/adstar"

# ---- documents of each package -----------------------------------------------------------------------
papers() {  # component, package
  local doc=$output/$1/doc/$2
  mkdir -p "$doc"
  cat > "$doc/copyright" <<TEXT
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: adstar

Files: *
Copyright: ${day%%-*} the authors of adstar
License: Apache-2.0
 On Debian systems the full text is in /usr/share/common-licenses/Apache-2.0.
TEXT
  gzip -9n < "$source/CHANGELOG.md" > "$doc/changelog.gz"
  gzip -9n > "$doc/changelog.Debian.gz" <<TEXT
adstar ($version-1) bookworm; urgency=medium

  * Made from its own tree; what is new: changelog.gz.

 -- $contact  $(date -R -d "@$SOURCE_DATE_EPOCH")
TEXT
}
# Pages keep their place below /usr/share/adstar, where help and messages name them; /usr/share/doc, which the image of a container may
# be without, leads there.
document() {  # component, package, files of the tree
  local file doc
  for file in "${@:3}"; do
    install -D -m 644 "$source/$file" "$output/$1/adstar/$file"
    doc=$output/$1/doc/$2/$file
    mkdir -p "$(dirname "$doc")"
    ln -sr "$output/$1/adstar/$file" "$doc"
  done
}
papers adstar adstar
papers dev libadstar-dev
papers dashboard adstar-dashboard
document adstar adstar README.md service/README.md service/scene/README.md service/adstar/trade.md \
  $(cd "$source" && echo service/pages/*.md) \
  deploy/README.md deploy/security/README.md
document dev libadstar-dev include/adstar/README.md include/adstar/notation.md include/adstar/schemes.md include/adstar/multibody/README.md

find "$output" -path '*/man/*' -type f -exec gzip -9n {} +
