#!/usr/bin/env bash
# Samples on all processors of this machine by GNU parallel, and their statistics.
#
#   ./parallel.sh rotor.mechanism 64 --set speed=3000rpm --samples 1000000
#
# With `--sshlogin` or PARALLEL="--sshloginfile hosts" the shards go to other machines that have the command.
set -euo pipefail
mechanism=$1 shards=$2
shift 2
parts=$(mktemp --directory)
trap 'rm -r "$parts"' EXIT
seq "$shards" | parallel --will-cite --halt soon,fail=1 \
    eigentol sample "$mechanism" "$@" --threads 1 --shard "{}/$shards" --output "$parts/{}.json"
eigentol merge "$parts"/*.json
