#!/bin/sh
# A frame in parts by GNU parallel, here or on the machines of a list; options of render stand in FRAME:
#     SCENE=bricks-45 OUT=frame FRAME='--size 65536x65536' bench/jobs/frame_parallel.sh 64
#     SCENE=... OUT=... FRAME=... bench/jobs/frame_parallel.sh 64 --sshloginfile machines \
#       --env SCENE --env OUT --env FRAME
# One job a machine unless -j says otherwise: each uses all processors. Run again, only what is missing
# is drawn. With a task and their number it draws that part, and parallel is not needed:
# frame_parallel.sh 3 of 64.
set -eu
: "${SCENE:?the scene}" "${OUT:?the folder for the parts}"
mkdir -p "$OUT"
if [ "${2:-}" = of ]; then
  # shellcheck disable=SC2086 # several options
  exec "${QUADREL:-quadrel}" render "$SCENE" -o "$OUT/part-$1.exr" --task "$1/$3" ${FRAME:-}
fi
parts="${1:?how many parts}"
shift
seq "$parts" | parallel -j 1 "$@" "$0" {} of "$parts"
exec "${QUADREL:-quadrel}" join "$OUT"/part-*.exr -o "$OUT.exr"
