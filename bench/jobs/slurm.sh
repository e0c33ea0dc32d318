#!/bin/sh
# A sweep as an array of jobs, each on a machine that it has for itself:
#     PLAN=bench/plans/everything.json OUT=sweep sbatch --array=1-8 bench/jobs/slurm.sh
#     quadrel sweep --merge sweep/part-* -o sweep
# Parts that were lost, again; PARTS is how many there were in all:
#     PLAN=... OUT=sweep PARTS=8 sbatch --array=2,5 bench/jobs/slurm.sh
#SBATCH --job-name=quadrel-sweep
#SBATCH --exclusive
#SBATCH --ntasks=1
#SBATCH --output=quadrel-sweep-%A-%a.log
set -eu
: "${PLAN:?the plan}" "${OUT:?the folder for the parts}"
task="${SLURM_ARRAY_TASK_ID:?to be run by sbatch --array=1-N}"
if [ -z "${PARTS:-}" ]; then
  PARTS="${SLURM_ARRAY_TASK_COUNT:?to be run by sbatch --array=1-N}"
  # An array of some of the parts has a count of its own.
  if [ "${SLURM_ARRAY_TASK_MIN:-1}" -ne 1 ] || [ "${SLURM_ARRAY_TASK_MAX:-$PARTS}" -ne "$PARTS" ] ||
      [ "$task" -gt "$PARTS" ]; then
    echo "$0: found an array that is not 1-N (task $task, $PARTS tasks), expected PARTS=N" >&2
    exit 2
  fi
fi
exec "${QUADREL:-quadrel}" sweep "$PLAN" -o "$OUT/part-$task" --task "$task/$PARTS" --quiet
