#!/usr/bin/env bash
#SBATCH --job-name=eigentol
#SBATCH --array=1-64
#SBATCH --cpus-per-task=1
# One shard of a run for each task of the array:
#
#   sbatch slurm.sh rotor.mechanism --set speed=3000rpm --samples 100000000
#   eigentol merge part-*.json
#
# A task that failed is repeated alone: sbatch --array=7 slurm.sh ...; `merge` names the shards that are missing.
set -euo pipefail
mechanism=$1
shift
exec eigentol sample "$mechanism" "$@" --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --output "part-$SLURM_ARRAY_TASK_ID.json"
