#!/bin/sh
# Sweeps on two engines for real: a job array of Slurm on this machine, and HyperQueue with two workers; in both a task
# is killed in the middle and its share submitted again. Both must give the same bytes as the runs one after the other,
# except for the command in the column `origin`.
# Installs what it needs (Debian packages slurmctld, slurmd, slurm-client, munge; the Python package hyperqueue), for
# which it has to be root; what cannot be installed is said and left out, and the script then ends with 77.
#
#     tests/cluster.sh [DIRECTORY]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
work=${1:-$(mktemp -d)}
mkdir -p "$work"
work=$(cd "$work" && pwd)
skipped=0
cleanup() {
    for daemon in slurmd slurmctld; do
        [ ! -s "$work/$daemon.pid" ] || kill "$(cat "$work/$daemon.pid")" 2> /dev/null || true
    done
}
trap cleanup EXIT

cd "$root"
cargo build --release --quiet -p motile-cli
MOTILE=${CARGO_TARGET_DIR:-$root/target}/release/motile
export MOTILE
cat > "$work/plan.toml" << 'PLAN'
time = 30.0
seeds = 2

[grid]
"droplets.0.particles.activity" = [-2.0, -3.0, -4.0]
viscosity = [50.0, 100.0]

[[scene.droplets]]
name = "cell"
PLAN
# Runs of the plan are in 12 folders; `same ENGINE` compares its table with that of the runs in one process.
sweep() { "$MOTILE" sweep "$work/plan.toml" "$@"; }
now() { date +%s.%N; }
since() { echo "$(now) $1" | awk '{ printf "%.1f s", $1 - $2 }'; }
numbers() { sed 's/,"*motile [0-9].*$//' "$1/trajectory.csv"; }
same() {
    sweep collect --out "$work/$1"
    cmp "$work/serial/results.csv" "$work/$1/results.csv"
    for run in "$work"/serial/runs/*; do
        numbers "$run" > "$work/serial.numbers"
        numbers "$work/$1/runs/$(basename "$run")" | cmp "$work/serial.numbers" -
    done
    echo "$1: the same bytes as in one process"
}

start=$(now)
sweep --quiet --threads 1 --out "$work/serial" 2> "$work/serial.log"
echo "one process: $(since "$start")"
sweep collect --out "$work/serial"

# --- HyperQueue, by its Python package: a server and two workers, without the command line `hq`
python=$(command -v python3 || true)
if [ -n "$python" ] && { [ -d "$work/hq" ] || "$python" -m venv "$work/hq"; } &&
    "$work/hq/bin/pip" install --quiet hyperqueue==0.27.0; then
    cat > "$work/shares.py" << 'PYTHON'
import glob, os, signal, subprocess, sys, time
from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

script, plan, out = sys.argv[1:]
# Tasks are counted from 0 here and from 1 in `hq submit --array 1-4`.
line = f'export HQ_TASK_ID=$((HQ_TASK_ID + 1)); exec {script} 4 {plan} --out {out} 2>> {out}.log'
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    client = cluster.client()

    def submitted():
        job = Job(max_fails=4)
        for _ in range(4):
            job.program(["sh", "-c", line])
        return client.submit(job)

    first = submitted()
    while not glob.glob(f"{out}/runs/*/checkpoint"):
        time.sleep(0.02)
    tasks = subprocess.run(["pgrep", "-f", f"motile sweep {plan} --out {out}"], capture_output=True, text=True).stdout.split()
    os.kill(int(tasks[0]), signal.SIGKILL)
    print(f"killed one of {len(tasks)} tasks")
    client.wait_for_jobs([first], raise_on_error=False)
    subprocess.run([os.environ["MOTILE"], "sweep", plan, "status", "--out", out], check=False)
    client.wait_for_jobs([submitted()])
PYTHON
    start=$(now)
    cd "$work"
    "$work/hq/bin/python" "$work/shares.py" "$root/examples/cluster/hyperqueue.sh" "$work/plan.toml" \
        "$work/hyperqueue" 2> "$work/shares.py.log"
    cd "$root"
    echo "HyperQueue: $(since "$start")"
    sweep status --out "$work/hyperqueue"
    same hyperqueue
else
    echo "HyperQueue cannot be installed here: left out"
    skipped=1
fi

# --- Slurm
command -v slurmctld > /dev/null && command -v slurmd > /dev/null && command -v sbatch > /dev/null || {
    export DEBIAN_FRONTEND=noninteractive
    (apt-get update -qq && apt-get install -y -qq --no-install-recommends slurmctld slurmd slurm-client munge) \
        > "$work/apt.log" 2>&1 || true
}
if command -v slurmctld > /dev/null && command -v slurmd > /dev/null && [ "$(id -u)" = 0 ]; then
    host=$(hostname -s)
    mkdir -p "$work/slurm/state" "$work/slurm/spool"
    munge=$work/munge
    cat > "$work/slurm.conf" << CONF
ClusterName=motile
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$munge/socket
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort=26817
SlurmdPort=26818
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/slurm/state
SlurmdSpoolDir=$work/slurm/spool
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
    SLURM_CONF=$work/slurm.conf
    export SLURM_CONF
    mkdir -p "$munge"
    chmod 700 "$munge"
    dd if=/dev/urandom of="$munge/key" bs=1024 count=1 2> /dev/null
    chmod 600 "$munge/key"
    munged --force --key-file="$munge/key" --socket="$munge/socket" --pid-file="$munge/pid" \
        --log-file="$munge/log" --seed-file="$munge/seed" || true
    slurmctld && slurmd
    tries=0
    until sinfo -h -o %T 2> /dev/null | grep -q idle; do
        tries=$((tries + 1))
        [ "$tries" -lt 60 ] || { echo "Slurm does not start:"; tail -n 5 "$work"/slurm*.log; exit 1; }
        sleep 0.5
    done
    start=$(now)
    cd "$work"
    job=$(sbatch --parsable --array=1-4 --chdir="$work" "$root/examples/cluster/slurm.sh" "$work/plan.toml" \
        --out "$work/slurm-sweep")
    # One task is cancelled in the middle; the array is submitted again.
    until ls "$work"/slurm-sweep/runs/*/checkpoint > /dev/null 2>&1; do sleep 0.05; done
    scancel --signal=KILL "${job}_1" || true
    while [ -n "$(squeue -h -j "$job" 2> /dev/null)" ]; do sleep 0.5; done
    sweep status --out "$work/slurm-sweep"
    job=$(sbatch --parsable --array=1-4 --chdir="$work" "$root/examples/cluster/slurm.sh" "$work/plan.toml" \
        --out "$work/slurm-sweep")
    while [ -n "$(squeue -h -j "$job" 2> /dev/null)" ]; do sleep 0.5; done
    echo "Slurm: $(since "$start")"
    cd "$root"
    sweep status --out "$work/slurm-sweep"
    same slurm-sweep
    [ ! -s "$munge/pid" ] || kill "$(cat "$munge/pid")"
else
    echo "Slurm cannot be installed here, or this is not root: left out"
    skipped=1
fi
[ "$skipped" = 0 ] || exit 77
