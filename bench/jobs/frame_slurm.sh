#!/bin/sh
# A frame in parts as an array of jobs; what stands behind the script's name are options of render:
#     SCENE=bricks-45 OUT=frame sbatch --array=1-64 bench/jobs/frame_slurm.sh --size 65536x65536
#     quadrel join frame/part-*.exr -o frame.exr
# Submitted again, only what is missing is drawn.
#SBATCH --job-name=quadrel-frame
#SBATCH --exclusive
#SBATCH --ntasks=1
#SBATCH --output=quadrel-frame-%A-%a.log
set -eu
: "${SCENE:?the scene}" "${OUT:?the folder for the parts}"
task="${SLURM_ARRAY_TASK_ID:?to be run by sbatch --array=1-N}"
mkdir -p "$OUT"
exec "${QUADREL:-quadrel}" render "$SCENE" -o "$OUT/part-$task.exr" \
  --task "$task/${SLURM_ARRAY_TASK_COUNT:?}" "$@"
