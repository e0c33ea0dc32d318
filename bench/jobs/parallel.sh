#!/bin/sh
# A sweep in parts by GNU parallel, here or on the machines of a list:
#     PLAN=bench/plans/everything.json OUT=sweep bench/jobs/parallel.sh 8
#     PLAN=... OUT=... bench/jobs/parallel.sh 8 --sshloginfile machines --env PLAN --env OUT
# One job a machine unless -j says otherwise: times of jobs that share processors are worth little.
# With a task and their number it runs that task, and parallel is not needed: parallel.sh 3 of 8.
set -eu
: "${PLAN:?the plan}" "${OUT:?the folder for the parts}"
if [ "${2:-}" = of ]; then
  exec "${QUADREL:-quadrel}" sweep "$PLAN" -o "$OUT/part-$1" --task "$1/$3" --quiet
fi
parts="${1:?how many parts}"
shift
seq "$parts" | parallel -j 1 "$@" "$0" {} of "$parts"
exec "${QUADREL:-quadrel}" sweep --merge "$OUT"/part-* -o "$OUT"
