#!/usr/bin/env bash
# Installs what adstar builds and runs with, from Debian 12 packages. Asks apt only for what is missing.
#   bash deploy/install-deps.sh            build and run
#   bash deploy/install-deps.sh --tests    and what the test suite needs besides
set -euo pipefail

packages=(
  g++ cmake ninja-build                    # build
  libeigen3-dev                            # core
  cyclonedds-dev cyclonedds-tools          # DDS (C API) and idlc
  openssl                                  # keys and certificates of deploy/security
  libspdlog-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libxxhash-dev
  liberfa-dev                              # dates, and how the Earth stands
  libsqlite3-dev                           # recordings
  libxsimd-dev                             # fleets: several bodies a register
  libcpp-httplib-dev pkg-config            # adstar dashboard serves its page
  pybind11-dev python3-dev python3-numpy   # the Python package
)
# The page itself: whatever npm is there will do, Debian's or another.
command -v npm >/dev/null || packages+=(nodejs npm)
if [[ "${1:-}" == "--tests" ]]; then
  packages+=(clang libclang-rt-14-dev clang-format clang-tidy doxygen libgtest-dev libgmock-dev libbenchmark-dev libboost-dev
             iproute2 git procps bash-completion valgrind chromium
             python3-pytest python3-matplotlib mypy
             dpkg-dev file help2man lowdown mandoc sqlite3)
elif [[ -n "${1:-}" ]]; then
  echo "usage: install-deps.sh [--tests]" >&2
  exit 2
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ "$state" == "installed" ]] || missing+=("$package")
done
# Its package would start a service that listens on every interface: unpacked, not installed. The tests look here too.
unpacked=/usr/local/lib/adstar-tests
prometheus=false
if [[ "${1:-}" == "--tests" && ! -x "$unpacked/usr/bin/prometheus" ]] && ! command -v prometheus >/dev/null; then
  prometheus=true
fi
if [[ ${#missing[@]} -eq 0 && $prometheus == false ]]; then
  exit 0
fi

if [[ $EUID -eq 0 ]]; then
  as_root=()
elif command -v sudo >/dev/null; then
  as_root=(sudo)
else
  if [[ ${#missing[@]} -eq 0 ]]; then
    echo "install-deps.sh: without root the test of Prometheus is skipped" >&2
    exit 0
  fi
  echo "install-deps.sh: missing: ${missing[*]}" >&2
  echo "install-deps.sh: run as root, or: apt-get install ${missing[*]}" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi
if [[ $prometheus == true ]]; then
  echo "Unpacking: prometheus, into $unpacked"
  download=$(mktemp -d)
  chmod 755 "$download"
  (cd "$download" && apt-get download -qq -o APT::Sandbox::User=root prometheus)
  "${as_root[@]}" dpkg-deb -x "$download"/prometheus_*.deb "$unpacked"
  rm -r "$download"
fi
