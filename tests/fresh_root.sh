#!/bin/sh
# All tests in a fresh minimal root of a Debian release, as somebody has them who has just cloned:
#   tests/fresh_root.sh RELEASE [--mirror URL] [--root DIR] [COMMAND…]
#   tests/fresh_root.sh trixie
#   tests/fresh_root.sh bookworm --root /var/tmp/bookworm
#   tests/fresh_root.sh trixie --root /var/tmp/trixie ./gnomon test -R render
# Needs root rights and debootstrap. The root is made in a temporary folder that goes at the end,
# whatever happens; with --root it stays there, and the next call with it goes on from what was
# installed and built. The checkout's last commit is cloned into it: what is not committed is not
# tested. The command, `./gnomon test` if there is none, runs in the clone; its status is the status.
set -eu

usage() {
  echo "fresh_root.sh: $1
usage: tests/fresh_root.sh RELEASE [--mirror URL] [--root DIR] [COMMAND…]" >&2
  exit 2
}

checkout=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
[ $# -gt 0 ] || usage "no release"
release=$1
shift
mirror=
root=
while [ $# -gt 0 ]; do
  case $1 in
    --mirror | --root)
      [ $# -gt 1 ] || usage "$1: a value expected"
      if [ "$1" = --mirror ]; then mirror=$2; else root=$2; fi
      shift 2
      ;;
    -*) usage "unknown option $1" ;;
    *) break ;;
  esac
done
[ $# -gt 0 ] || set -- ./gnomon test
[ "$(id -u)" -eq 0 ] || usage "root rights expected: debootstrap and chroot need them"
for tool in debootstrap unshare git; do
  command -v "$tool" >/dev/null || usage "$tool is not installed"
done

# Mounts are made in a name space of their own: they end with the processes in it, so that removing
# the folder can never reach what is mounted there.
if [ -z "${GNOMON_FRESH_ROOT_MOUNTS:-}" ]; then
  if [ -n "$root" ]; then
    mkdir -p "$root"
    root=$(CDPATH='' cd -- "$root" && pwd)
  else
    root=$(mktemp -d "${TMPDIR:-/tmp}/gnomon-$release-XXXXXX")
    trap 'rm -rf --one-file-system "$root"' EXIT
    trap 'exit 129' HUP
    trap 'exit 130' INT
    trap 'exit 143' TERM
  fi
  if [ ! -e "$root/gnomon-root-made" ]; then
    # shellcheck disable=SC2086  # no mirror is no word
    debootstrap --variant=minbase "$release" "$root" $mirror
    echo "$release" >"$root/gnomon-root-made"
  elif [ "$(cat "$root/gnomon-root-made")" != "$release" ]; then
    usage "$root holds $(cat "$root/gnomon-root-made"), $release expected"
  fi
  if [ -d "$root/gnomon/.git" ]; then
    git -C "$root/gnomon" fetch --quiet "$checkout" HEAD
    git -C "$root/gnomon" reset --quiet --hard FETCH_HEAD
  else
    git clone --quiet --no-hardlinks "$checkout" "$root/gnomon"
  fi
  status=0
  GNOMON_FRESH_ROOT_MOUNTS=1 unshare --mount --pid --fork --kill-child \
    sh "$0" "$release" --root "$root" "$@" || status=$?
  exit "$status"
fi

mount --make-rprivate /
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 \
  PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  DEBIAN_FRONTEND=noninteractive sh -c 'cd /gnomon && exec "$@"' sh "$@"
