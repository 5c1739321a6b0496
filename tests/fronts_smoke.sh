#!/usr/bin/env bash
# bench/fronts.py on its smallest problem: it runs, draws and tabulates, and a second call runs nothing.
# usage: fronts_smoke.sh SOURCE_ROOT PROGRAM OUTPUT
set -euo pipefail

root=$1 program=$2 output=$3
fronts() {
  PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$root/bench/fronts.py" unit-cell --quick \
    --program "$program" --output "$output"
}
rm -rf -- "$output"
fronts
grep -q '^# compiler: ' "$output/unit-cell.csv"
grep -q '^| mesh | 16/1 |' "$output/summary.md"
[[ $(head -c 4 "$output/unit-cell.png" | tail -c 3) == PNG ]]
before=$(<"$output/unit-cell.csv")
fronts | tee "$output/second.log"
[[ $(wc -l <"$output/second.log") == 1 ]]
[[ $before == "$(<"$output/unit-cell.csv")" ]]
