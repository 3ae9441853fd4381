#!/bin/sh
# The runs of a plan as a task array of HyperQueue, each task a share of them; the first argument is their number:
#
#     cargo build --release -p motile-cli
#     hq submit --array 1-8 examples/cluster/hyperqueue.sh 8 plan.toml --out /shared/sweep
#
# HyperQueue starts a task again whose worker is lost, and a task that is cut goes on when it is submitted again: its
# runs go on from their checkpoints.
shares=$1
shift
exec "${MOTILE:-target/release/motile}" sweep "$@" --quiet --threads 1 --shard "$HQ_TASK_ID/$shares"
