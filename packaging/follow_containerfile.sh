#!/bin/sh
# Does in this very root what packaging/Containerfile says, line by line, then runs a command as its
# user in its folder:
#   packaging/follow_containerfile.sh COMMAND…
# For a root that is thrown away: see try_container.sh. Called in the checkout.
set -eu
user=root
folder=/

while read -r instruction words; do
  case $instruction in
    '' | '#'* | FROM | ENTRYPOINT) continue ;;
  esac
  echo "+ $instruction $words" >&2
  case $instruction in
    COPY)
      target=${words##* }
      mkdir -p "$target"
      # shellcheck disable=SC2086  # the words are files and patterns
      cp -r ${words% *} "$target"
      ;;
    RUN) sh -eu -c "$words" </dev/null >&2 ;;
    USER) user=$words ;;
    WORKDIR) folder=$words ;;
    *)
      echo "follow_containerfile.sh: $instruction found, FROM, COPY, RUN, USER, WORKDIR or ENTRYPOINT expected" >&2
      exit 2
      ;;
  esac
done <packaging/Containerfile

cd "$folder"
exec setpriv --reuid "$user" --regid "$user" --init-groups \
  env HOME="$folder" USER="$user" "$@"
