#!/bin/bash
# A sweep as an array of Slurm, on a cluster of one node that this script starts on the loopback:
# tasks are killed and requeued at random; what is merged must be the run without shards, byte for
# byte. Needs slurm-wlm and munge, and root, which slurmd runs as; exits with 77 where that cannot be.
#   slurm_test.sh GNOMON gnomon.sbatch
set -eu

gnomon=$1
sbatch=$2
cases=30 shards=6 kills=4
if [ "${GNOMON_LONG_TESTS:-}" = 1 ]; then cases=1000 shards=50 kills=40; fi

skip() {
  echo "skipped: $1"
  exit 77
}
fail() {
  echo "FAILED: $1" >&2
  exit 1
}
for program in slurmctld slurmd munged sbatch squeue scontrol; do
  PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || skip "no $program: Debian's slurm-wlm and munge have it"
done
[ "$(id -u)" -eq 0 ] || skip "only root can run slurmd"
PATH=$PATH:/usr/sbin

home=$(mktemp -d /tmp/gnomon-slurm-XXXXXX)
chmod 700 "$home"
stop() {
  for name in slurmd slurmctld munged; do
    [ -f "$home/$name.pid" ] && kill "$(cat "$home/$name.pid")" 2>/dev/null || true
  done
  sleep 1
  rm -rf "$home"
}
trap stop EXIT

# The cluster.
head -c 1024 /dev/urandom > "$home/munge.key"
chmod 400 "$home/munge.key"
munged --force --key-file="$home/munge.key" --socket="$home/munge.sock" --pid-file="$home/munged.pid" \
  --log-file="$home/munged.log" --seed-file="$home/munged.seed" --num-threads=2 || skip "munged does not start"
mkdir "$home/state" "$home/spool"
# Two free ports: a suite may run twice on one machine.
port=$((20000 + $$ % 20000))
cat > "$home/slurm.conf" <<C
ClusterName=gnomon
SlurmctldHost=localhost
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
# A task that is requeued starts again after so many seconds.
AuthInfo=socket=$home/munge.sock,cred_expire=3
CredType=cred/munge
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
SlurmctldLogFile=$home/slurmctld.log
SlurmdLogFile=$home/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1
MaxArraySize=2001
MaxJobCount=10000
MpiDefault=none
ReturnToService=2
NodeName=localhost CPUs=$(nproc) RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
C
export SLURM_CONF=$home/slurm.conf
slurmctld -f "$SLURM_CONF" && slurmd -f "$SLURM_CONF" -N localhost || skip "slurmd does not start: $(tail -n 1 "$home"/slurm*.log)"
for _ in $(seq 60); do
  sinfo -h -o %t 2>/dev/null | grep -q idle && break
  sleep 0.5
done
sinfo -h -o %t 2>/dev/null | grep -q idle || skip "the node does not come up: $(tail -n 1 "$home/slurmd.log")"

# The sweep: columns of so many heights on a small plane.
cd "$home"
cat > small.toml <<T
[study]
name = "small"
title = "Columns on a plane"
source = "a test"
[surface]
shape = "plane"
quads = [4, 4]
size = [32, 32]
[relief]
pattern = "columns"
texels = [32, 32]
period = 16
radius = 4
wall = 1
height = 4
height_space = "world"
[bake]
azimuths = 8
[truth]
step = 0.5
[[view]]
type = "camera"
width = 64
height = 64
eye = [0, 0, 80]
fov = 30
[[light]]
name = "evening"
azimuth = 20
elevation = 30
[[method]]
name = "unshadowed"
[[method]]
name = "max-forsyth"
[sweep]
key = "relief.height"
values = [$(seq -s ', ' "$cases")]
T
export GNOMON_CACHE=$home/cache GNOMON=$gnomon GNOMON_RETRIES=100
# Figures alone: a folder without times, which two runs share to the byte.
options="--metrics-only --no-cache"

# The array, and what happens to it.
job=$(sbatch --parsable --array="1-$shards" --cpus-per-task=1 --output="$home/task-%a.log" "$sbatch" \
  small.toml $options)
RANDOM=7
killed=0 requeued=0
while [ -n "$(squeue -h -j "$job" -o %i 2>/dev/null)" ]; do
  sleep 0.$((RANDOM % 10))
  [ $((killed + requeued)) -lt "$kills" ] || { sleep 1; continue; }
  mapfile -t running < <(squeue -h -j "$job" -t R -o "%A %K")
  [ "${#running[@]}" -gt 0 ] || continue
  read -r id task <<< "${running[RANDOM % ${#running[@]}]}"
  if [ $((RANDOM % 2)) = 0 ]; then
    # As the kernel does where memory runs out: the task's own script starts it again.
    for pid in $(scontrol listpids "$id" 2>/dev/null | awk 'NR > 1 { print $1 }'); do
      [ "$(cat "/proc/$pid/comm" 2>/dev/null)" = gnomon ] || continue
      kill -KILL "$pid" 2>/dev/null && killed=$((killed + 1))
    done
  else
    # As an operator does who takes the node away.
    scontrol requeue "${job}_$task" 2>/dev/null && requeued=$((requeued + 1))
  fi
done
echo "$cases cases in $shards tasks: $killed times killed, $requeued times requeued"
[ $((killed + requeued)) -gt 0 ] || fail "no task was killed"
for task in $(seq "$shards"); do
  grep -q '"whole": true' "shards/$task/shard.json" || fail "task $task: $(tail -n 3 "task-$task.log")"
done
# No case was measured twice: a task that is started again goes on.
twice=$(grep -hE '^small/' task-*.log | sort | uniq -d | wc -l)
[ "$twice" -eq 0 ] || fail "$twice cases were told twice"

# In an order of its own.
"$gnomon" merge $(seq "$shards" | sed 's#^#shards/#' | sort -r) --out out --no-cache > merge.log || fail "$(cat merge.log)"
mv out merged
"$gnomon" --threads 1 run small.toml $options --out out > run.log || fail "$(cat run.log)"
diff -r merged out > difference.log || fail "$(head -n 5 difference.log)"
rows=$(grep -c . out/small/cases.csv)
[ "$rows" -gt "$cases" ] || fail "$rows rows alone"
echo "merge and the run without shards are the same: $rows rows"
