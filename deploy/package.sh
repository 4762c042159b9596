#!/usr/bin/env bash
# Makes the Debian packages adstar, libadstar-dev and adstar-dashboard: build/release/packages/*.deb.
#   bash deploy/package.sh
#   apt install ./build/release/packages/*.deb
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash deploy/install-deps.sh
missing=()
for package in dpkg-dev file help2man lowdown; do
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' $package 2> /dev/null)" == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "package.sh: packages are made with ${missing[*]} besides: apt-get install ${missing[*]}" >&2
  exit 1
fi

cmake --preset release -DADSTAR_BUILD_TESTS=OFF -DADSTAR_BUILD_DASHBOARD=ON > /dev/null
cmake --build build/release --target packages
ls build/release/packages/*.deb
