#!/bin/sh
# What a new user tries first, with the package installed and no other right: a run, a starter of
# their own, a check that passes and one that fails. Each step must end as it says.
set -eu

step() {
  expected=$1
  shift
  begin=$(date +%s)
  status=0
  "$@" >step.log 2>&1 || status=$?
  seconds=$(($(date +%s) - begin))
  [ "$status" -eq "$expected" ] || {
    cat step.log
    echo "FAILED: $*: exit status $status, $expected expected"
    exit 1
  }
  echo "$seconds s, exit status $status: $*"
}

[ "$(id -u)" -ne 0 ] || { echo "FAILED: root found, a plain user expected"; exit 1; }
work=$(mktemp -d)
cd "$work"
step 0 gnomon --version
step 0 gnomon list
step 0 gnomon run /usr/share/gnomon/scenes/figure8.toml
step 0 gnomon bake /usr/share/gnomon/scenes/figure8.toml
step 0 gnomon init mine --action none
cd mine
step 0 gnomon run shadows/shadows.toml
step 0 gnomon check shadows/shadows.toml --baseline shadows/references \
  --update-baseline --baseline-pictures --reason first
step 0 gnomon check shadows/shadows.toml --baseline shadows/references
sed -i 's/> bias/> bias - 0.1/' shadows/my-shadow.glsl
step 1 gnomon check shadows/shadows.toml --baseline shadows/references --summary summary.md
grep -q 'my-shadow.glsl' summary.md || { echo "FAILED: no shader in the summary"; exit 1; }
cd ..
test -s /usr/share/man/man1/gnomon.1 || test -s /usr/share/man/man1/gnomon.1.gz
test -s /usr/share/doc/gnomon/copyright

# A checkout without the packages to build it, and without root: it says what is missing.
cp /gnomon/gnomon /gnomon/packages.txt .
step 2 ./gnomon list
grep -q 'apt-get install --no-install-recommends .*libembree-dev' step.log
echo "All as expected."
