#!/usr/bin/env bash
# Builds of the program give the same bits: builds_agree.sh SOURCE_DIR PROGRAM PROGRAM...
# Runs scenes of all families with 1, 2, 3 and 8 threads with each program (THREADS="1 3": with these), so many times
# each (RUNS=3; 1), or some of the scenes (SCENES="impact loop"), or as on other processors too, by what glibc is
# told not to use (PROCESSORS="all -FMA,-FMA4,-AVX2"); prints the hashes of the last state and of the
# history, and fails where one differs from the first. Other builds are made on demand:
# cmake --preset debug && cmake --build --preset debug --target pulvis (or clang-release).
set -euo pipefail
source=$(readlink -f -- "$1")
shift
place=$(mktemp -d)
trap 'rm -rf -- "$place"' EXIT

brief=(--set output.frames=1 --set output.samples=10)
fast=("${brief[@]}" --set "stage.press.duration=50 us"
      --set 'stage.press.move[0].displacement=["0 mm", "-1.25 mm"]')
pentagons=("${brief[@]}" --set particle.disc.outline=polygon --set particle.disc.sides=5
           --set 'particle.disc.rounding=1 mm' --set 'packing[0].density=0.5'
           --set 'stage.press.duration=30 us'
           --set 'stage.press.move[0].displacement=["0 mm", "-0.5 mm"]')
traced=("${brief[@]}" --set 'stage.press.duration=20 us'
        --set 'stage.press.move[0].displacement=["0 mm", "0.1 mm"]')
declare -A expected=()
status=0

run() {  # PROGRAM NAME THREADS SCENE OPTION...
  local program=$1 name=$2 threads=$3 scene=$4 hash
  shift 4
  [[ " ${SCENES:-$name} " == *" $name "* ]] || return 0
  GLIBC_TUNABLES=$tunables "$program" run "$source/scenes/$scene" -o "$place/run" --overwrite \
    --threads "$threads" "$@" \
    >/dev/null
  hash=$(sed -n 's/.*"state_hash": "\([0-9a-f]\{16\}\)".*/\1 /p' "$place/run/summary.json")
  [[ $hash ]] || { echo "$program gives no state_hash of $name" >&2; exit 1; }
  hash+=$(sha256sum <"$place/run/history.csv" | cut -c 1-16)
  : "${expected[$name]:=$hash}"
  printf '%-22s %s threads %s  %s %s\n' "$name" "$threads" "$hash" "$program" "$tunables"
  if [[ $hash != "${expected[$name]}" ]]; then
    echo "    differs from ${expected[$name]}"
    status=1
  fi
}

all() {  # PROGRAM THREADS
  run "$1" one-point "$2" compaction/regular-25.toml "${fast[@]}"
  run "$1" four-point "$2" compaction/regular-25.toml "${fast[@]}" \
    --set element.formulation=four-point
  run "$1" pentagons "$2" compaction/random-100.toml "${pentagons[@]}"
  run "$1" traced "$2" basic/traced-grain.toml "${traced[@]}"
  run "$1" impact "$2" basic/oblique-impact.toml --set output.frames=1
  run "$1" loop "$2" afm/loop-beam-0.toml
  run "$1" ball "$2" afm/plastic-probe.toml
}

for program in "$@"; do
  for processor in ${PROCESSORS:-all}; do
    tunables=
    if [[ $processor != all ]]; then tunables=glibc.cpu.hwcaps=$processor; fi
    for threads in ${THREADS:-1 2 3 8}; do
      for ((i = 0; i < ${RUNS:-1}; ++i)); do all "$program" "$threads"; done
    done
  done
done
if ((${#expected[@]} == 0)); then
  echo "nothing was run" >&2
  status=1
fi
exit "$status"
