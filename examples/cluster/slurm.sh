#!/bin/sh
# The runs of a plan as a job array of Slurm, each task a share of them:
#
#     cargo build --release -p motile-cli
#     sbatch --array=1-8 examples/cluster/slurm.sh plan.toml --out /shared/sweep
#
# A task that is cut goes on when the same array is submitted again.
#SBATCH --job-name=motile-sweep
#SBATCH --cpus-per-task=1
#SBATCH --output=motile-sweep-%A-%a.log
exec "${MOTILE:-target/release/motile}" sweep "$@" --quiet --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
