#!/bin/sh
# A sweep as an array of jobs, each on a machine that it has for itself:
#     PLAN=bench/plans/everything.json OUT=sweep sbatch --array=1-8 bench/jobs/slurm.sh
#     quadrel sweep --merge sweep/part-* -o sweep
#SBATCH --job-name=quadrel-sweep
#SBATCH --exclusive
#SBATCH --ntasks=1
#SBATCH --output=quadrel-sweep-%A-%a.log
set -eu
: "${PLAN:?the plan}" "${OUT:?the folder for the parts}"
task="${SLURM_ARRAY_TASK_ID:?to be run by sbatch --array=1-N}"
exec "${QUADREL:-quadrel}" sweep "$PLAN" -o "$OUT/part-$task" \
  --task "$task/${SLURM_ARRAY_TASK_COUNT:?}" --quiet
