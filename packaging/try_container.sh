#!/bin/sh
# Tries the Debian package and the container as a new user would, in a fresh minimal root:
#   packaging/try_container.sh [--root DIR] PACKAGE.deb
# Needs root rights and debootstrap, as tests/fresh_root.sh, which makes the root. The last commit's
# packaging/ is tried. Says at the end how long the user's commands took.
set -eu
checkout=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
root=
if [ "${1:-}" = --root ]; then
  root=${2:?--root: a folder expected}
  shift 2
fi
[ $# -eq 1 ] && [ -f "$1" ] || {
  echo "usage: packaging/try_container.sh [--root DIR] PACKAGE.deb" >&2
  exit 2
}
package=$(realpath "$1")
release=$(sed -n 's/^FROM debian://p' "$checkout/packaging/Containerfile")
if [ -z "$root" ]; then
  root=$(mktemp -d "${TMPDIR:-/tmp}/gnomon-container-XXXXXX")
  trap 'rm -rf --one-file-system "$root"' EXIT
fi
"$checkout/tests/fresh_root.sh" "$release" --root "$root" true
mkdir -p "$root/gnomon/build/packages"
cp "$package" "$root/gnomon/build/packages/"
"$checkout/tests/fresh_root.sh" "$release" --root "$root" \
  packaging/follow_containerfile.sh sh /gnomon/packaging/try_user.sh
