#!/bin/bash
# How much processor time is lost when a run is divided: that of one shard over that of many, on cases
# of equal kind: a sweep over the columns on a sphere of Figure 4, of their height, where every case has
# a mesh of its own, or of the light's azimuth, where all cases of a run share one.
#   shard_efficiency.sh GNOMON [CASES [SHARDS [height|light]]]        GNOMON: build/release/gnomon
# Prints seconds of the processor, user and system, of one shard, of all, and of merge.
set -eu
gnomon=$(realpath "$1") cases=${2:-128} shards=${3:-64} kind=${4:-height}
case $kind in
  height) key=relief.height first=2 last=6 ;;
  light) key=light.0.azimuth first=0 last=300 ;;
  *) echo "height or light expected, $kind found" >&2; exit 2 ;;
esac
scenes=$(realpath "$(dirname "$0")/../../scenes")
work=$(mktemp -d /tmp/gnomon-efficiency-XXXXXX)
trap 'rm -rf "$work"' EXIT
cd "$work"
# The lights of the study give way to one that is swept; nothing is judged.
awk '/^\[/ { drop = /^\[\[(light|threshold|claim|ladder)/ } !drop' "$scenes/sphere-columns.toml" > study.toml
cat >> study.toml <<T

[[light]]
azimuth = 0
elevation = 30

[sweep]
key = "$key"
values = [$(awk "BEGIN { for (i = 0; i < $cases; ++i) printf \"%s%.6g\", i ? \", \" : \"\", $first + ($last - $first) * i / $cases }")]
T
options="--quick --metrics-only"
TIMEFORMAT='%U %S'
seconds() {  # of the processor that a command takes
  { time "$@" > log 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}
# The shards share a cache, as on shared storage; it is empty when the first begins.
export GNOMON_CACHE=$work/cache-of-one
one=$(seconds "$gnomon" run study.toml $options --shard 1/1 --out one)
echo "one shard: $one s"
export GNOMON_CACHE=$work/cache-of-shards
all=0
for i in $(seq "$shards"); do
  part=$(seconds "$gnomon" run study.toml $options --shard "$i/$shards" --out "shards/$i")
  grep -q '"whole": true' "shards/$i/shard.json" || { cat log; exit 1; }
  all=$(awk "BEGIN { print $all + $part }")
done
echo "$shards shards: $all s"
echo "merge: $(seconds "$gnomon" merge shards/* --out merged) s"
awk "BEGIN { printf \"$cases cases in $shards shards: %.1f %% of the processor's time is that of one\n\", 100 * $one / $all }"
