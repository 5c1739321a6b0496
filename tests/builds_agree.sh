#!/usr/bin/env bash
# Builds of the program give the same bits: builds_agree.sh SOURCE_DIR PROGRAM PROGRAM...
# Scenes of three families with 1, 2, 3 and 8 threads with each program (THREADS="1 3": with these); prints the
# hashes of the last state, where the family has one, and of the history, and fails where one differs. Other builds
# are made on demand: cmake --preset debug && cmake --build --preset debug --target pulvis (or clang-release).
set -euo pipefail
source=$(readlink -f -- "$1")
shift
place=$(mktemp -d)
trap 'rm -rf -- "$place"' EXIT

fast=(--set "stage.press.duration=50 us"
      --set 'stage.press.move[0].displacement=["0 mm", "-1.25 mm"]'
      --set output.frames=1 --set output.samples=10)
declare -A expected
status=0

run() {  # PROGRAM NAME THREADS SCENE OPTION...
  local program=$1 name=$2 threads=$3 scene=$4 hash
  shift 4
  "$program" run "$source/scenes/$scene" -o "$place/run" --overwrite --threads "$threads" "$@" \
    >/dev/null
  hash=$(sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1 /p' "$place/run/summary.json")
  hash+=$(sha256sum <"$place/run/history.csv" | cut -c 1-16)
  : "${expected[$name]:=$hash}"
  printf '%-22s %s threads %s  %s\n' "$name" "$threads" "$hash" "$program"
  if [[ $hash != "${expected[$name]}" ]]; then
    echo "    differs from ${expected[$name]}"
    status=1
  fi
}

for program in "$@"; do
  for threads in ${THREADS:-1 2 3 8}; do
    run "$program" one-point "$threads" compaction/regular-25.toml "${fast[@]}"
    run "$program" four-point "$threads" compaction/regular-25.toml "${fast[@]}" \
      --set element.formulation=four-point
    run "$program" impact "$threads" basic/oblique-impact.toml --set output.frames=1
    run "$program" loop "$threads" afm/loop-beam-0.toml
  done
done
exit "$status"
