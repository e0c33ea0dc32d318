#!/bin/sh
# A frame in parts as an array of jobs; what stands behind the script's name are options of render:
#     SCENE=bricks-45 OUT=frame sbatch --array=1-64 bench/jobs/frame_slurm.sh --size 65536x65536
#     quadrel join frame/part-*.exr -o frame.exr
# Submitted again, only what is missing is drawn. Some parts alone; PARTS is how many there are in all:
#     SCENE=bricks-45 OUT=frame PARTS=64 sbatch --array=2,5 bench/jobs/frame_slurm.sh --size 65536x65536
#SBATCH --job-name=quadrel-frame
#SBATCH --exclusive
#SBATCH --ntasks=1
#SBATCH --output=quadrel-frame-%A-%a.log
set -eu
: "${SCENE:?the scene}" "${OUT:?the folder for the parts}"
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
mkdir -p "$OUT"
exec "${QUADREL:-quadrel}" render "$SCENE" -o "$OUT/part-$task.exr" --task "$task/$PARTS" "$@"
