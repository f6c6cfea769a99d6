#!/bin/sh
# A checkout that one user has built serves another, who may not write into it. The program and the
# module are stand-ins: what is tried is the script ./gnomon.
set -eu
gnomon=$1
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
chmod 755 "$work"
checkout=$work/checkout
mkdir -p "$checkout/build/release/python/gnomon"
cp "$gnomon" "$(dirname "$gnomon")/packages.txt" "$checkout"
for folder in validate app python cmake; do
  mkdir "$checkout/$folder"
  echo source >"$checkout/$folder/file"
done
touch -d '1 hour ago' "$checkout"/*/file
printf '#!/bin/sh\necho "program: $*"\nexit 7\n' >"$checkout/build/release/gnomon"
chmod +x "$checkout/build/release/gnomon"
touch "$checkout/build/lock" "$checkout/build/build.log"

# Calls ./gnomon as somebody who may not write, and checks status and output.
expect() {
  status=$1
  output=$2
  shift 2
  chmod -R a-w,a+rX "$checkout"
  found=0
  if [ "$(id -u)" -eq 0 ]; then
    setpriv --reuid=65534 --regid=65534 --clear-groups "$checkout/gnomon" "$@" >"$work/out" 2>&1 || found=$?
  else
    "$checkout/gnomon" "$@" >"$work/out" 2>&1 || found=$?
  fi
  chmod -R u+w "$checkout"
  if [ "$found" -ne "$status" ] || ! tr '\n' ' ' <"$work/out" | grep -qx "$output *"; then
    echo "./gnomon $*: status $found, $status expected; '$output' expected in"
    cat "$work/out"
    exit 1
  fi
}

expect 7 'program: list keys' list keys
expect 2 'gnomon: .*/_gnomon\*.so is not built, and you may not write into .*/build: .*' python
expect 2 'gnomon: test: you may not write into .*/build' test
expect 2 'gnomon: package: you may not write into .*/build' package
touch "$checkout/build/release/python/gnomon/_gnomon.abi3.so"
expect 0 '.*/checkout/build/release/python' python
touch -d '1 hour' "$checkout/validate/file"
expect 7 'gnomon: warning: .*/validate/file is newer than what is built, .* program: list' list
rm "$checkout/build/release/gnomon"
expect 2 'gnomon: .*/gnomon is not built, .* call ./gnomon list as its owner, .*' list
rm -r "$checkout/build"
expect 2 'gnomon: .*/gnomon is not built, .*' list
