#!/bin/sh
# Installs Gnomon's package on a Debian that has nothing else, as root:
#   packaging/install.sh PACKAGE.deb
# Leaves no lists and no downloads.
set -eu
[ $# -eq 1 ] && [ -f "$1" ] || {
  echo "install.sh: ${1:-nothing} found, a Debian package expected" >&2
  exit 2
}
package=$(realpath "$1")
apt-get update -q
apt-get install -q -y --no-install-recommends "$package"
apt-get clean
rm -rf /var/lib/apt/lists/*
