#!/bin/sh
# Kills runs of scenes, each twenty times at random moments, and resumes them from the checkpoint they have left.
#
# tests/kill_runs.sh [SCENE]... (default: elastic_walls rigid_channel), names of files in examples/scenes; the program
# motile has to be built, with cargo build --release -p motile-cli. Ends with an error where a run ends by itself: a
# checkpoint that is not complete, or one that cannot be resumed, makes it do so.
set -eu

kills=20
root=$(dirname "$0")/..
motile=${CARGO_TARGET_DIR:-$root/target}/release/motile
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

# A number of seconds between 0.3 and 3.
moment() {
    od -An -N2 -tu2 /dev/urandom | awk '{ printf "%.3f", 0.3 + 2.7 * $1 / 65536 }'
}

for names in "${@:-elastic_walls rigid_channel}"; do
    for name in $names; do
        state=$place/$name.checkpoint
        flags="run $root/examples/scenes/$name.toml --time 1e5 --no-pictures --quiet --checkpoint $state --checkpoint-every 1 --out $place/$name"
        killed=0
        while [ "$killed" -lt "$kills" ]; do
            resume=
            [ -e "$state" ] && resume="--resume $state"
            status=0
            # shellcheck disable=SC2086
            timeout -s KILL "$(moment)" "$motile" $flags $resume >"$place/output" 2>&1 || status=$?
            if [ "$status" -ne 137 ]; then
                echo "$name ended by itself after $killed kills:"
                cat "$place/output"
                exit 1
            fi
            killed=$((killed + 1))
        done
        # Ctrl-C saves one more and says so.
        # shellcheck disable=SC2086
        timeout -s INT 5 "$motile" $flags --resume "$state" >"$place/output" 2>&1 || true
        echo "$name: killed $kills times, $kills complete checkpoints; at the end: $(tail -n 1 "$place/output")"
    done
done
