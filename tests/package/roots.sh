# Sourced by tests that are scripts, after proof.sh: bare Debian 12 roots, and the packages in two versions. Whoever sources it has
# `build`, a tree that is built, and `work`, a directory of its own.

missing_tools() {  # name of the script, tools
  local tool
  [[ $EUID == 0 ]] || { echo "$1: SKIPPED: only root makes a root" >&2; exit 77; }
  for tool in debootstrap help2man lowdown dpkg-shlibdeps file "${@:2}"; do
    command -v "$tool" > /dev/null || {
      echo "$1: SKIPPED: $tool is missing: apt-get install debootstrap help2man lowdown dpkg-dev file iproute2 systemd-container" >&2
      exit 77
    }
  done
}

# $work/debs/first and second: the second has another setting.
make_two_versions() {
  local version newer
  local -A revision=([first]=1 [second]=2)
  mkdir "$work/debs"
  for version in first second; do
    (cd "$build" && cpack -D CPACK_DEBIAN_PACKAGE_RELEASE=${revision[$version]} -D CPACK_OUTPUT_FILE_PREFIX="$work/debs/$version" \
      -B "$work/making") > "$work/cpack.log" 2>&1 || fail "cpack"
  done
  newer=("$work"/debs/second/adstar_*.deb)
  dpkg-deb -R "${newer[0]}" "$work/opened"
  echo '# a later version says more here' >> "$work/opened/etc/adstar/demo.toml"
  dpkg-deb --root-owner-group -b "$work/opened" "${newer[0]}" > /dev/null
}

# So that apt does what deploy/README.md has somebody type, and asks nothing: APT_CONFIG, beside the packages.
apt_settings() {
  printf '%s\n' 'APT::Get::Assume-Yes "true";' 'APT::Install-Recommends "false";' 'quiet "2";' 'Dpkg::Use-Pty "false";' \
    'Dpkg::Options { "--force-confdef"; "--force-confold"; };' > "$work/debs/apt.conf"
}

# A minimal bookworm in `root`, by apt's own way to its registry; or a copy of one.
make_root() {  # root, a bare root or nothing
  local mirror
  if [[ -n "${2:-}" ]]; then
    cp -a "$2" "$1"
  else
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)
    debootstrap --variant=minbase bookworm "$1" ${mirror:+"$mirror"} > "$work/debootstrap.log" 2>&1 || fail "debootstrap"
  fi
  cp /etc/resolv.conf "$1/etc/resolv.conf"
  cp /etc/apt/apt.conf.d/*registry* "$1/etc/apt/apt.conf.d/" 2> /dev/null || true
  mkdir "$1/packages"
}
