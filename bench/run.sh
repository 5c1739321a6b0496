#!/usr/bin/env bash
# Runs a built benchmark several times and prints, for each of its lines, the least and the median time
# of all repetitions. Builds nothing.
#
# usage: bench/run.sh [PROGRAM [OPTION]...]     default: build/release/bench/throughput
#        RUNS=3          processes, one after the other
#        REPETITIONS=5   in each of them
# Options go to the program, as in: bench/run.sh build/release/bench/throughput --benchmark_filter=step
set -euo pipefail

root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
program=${1:-$root/build/release/bench/throughput}
if [[ ! -x $program ]]; then
  echo "bench/run.sh: there is no program $program; ./pulvis bench builds it" >&2
  exit 2
fi
results=$(mktemp -d)
trap 'rm -rf -- "$results"' EXIT

for ((run = 1; run <= ${RUNS:-3}; ++run)); do
  echo "run $run of ${RUNS:-3}, load $(cut -d ' ' -f 1 /proc/loadavg)" >&2
  "$program" --benchmark_repetitions="${REPETITIONS:-5}" --benchmark_out_format=json \
    --benchmark_out="$results/$run.json" "${@:2}" >"$results/log" 2>&1 || { cat "$results/log" >&2; exit 1; }
done

/usr/bin/python3 - "$results"/*.json <<'PYTHON'
import json
import statistics
import sys

runs = [json.load(open(file)) for file in sys.argv[1:]]
lines = {}  # name -> counter -> values of all repetitions
for run in runs:
    for line in run["benchmarks"]:
        if line["run_type"] == "iteration":
            name = "/".join(p for p in line["name"].split("/") if p.startswith("threads:") or not (":" in p or p == "manual_time"))
            counters = lines.setdefault(name, {})
            for key in ("ns_per_element_step", "items_per_second", "share", "bytes_per_element",
                        "of_bodies", "of_contact"):
                if key in line:
                    counters.setdefault(key, []).append(line[key])

context = runs[0]["context"]
for key in ("commit", "compiler", "threads"):
    print(f"{key:<10}{context[key]}")
count = max(len(values) for counters in lines.values() for values in counters.values())
print(f"{'samples':<10}{count}: {len(runs)} runs x {count // len(runs)} repetitions\n")
print(f"{'':<28}{'ns an element-step':>20}{'M element-updates/s':>22}{'share':>8}")
print(f"{'':<28}{'min':>10}{'median':>10}{'of min':>11}{'of median':>11}{'median':>8}")
for name, counters in lines.items():
    ns = counters.get("ns_per_element_step")
    if ns is None:
        continue
    text = f"{name:<28}{min(ns):10.3f}{statistics.median(ns):10.3f}"
    if "items_per_second" in counters:
        text += f"{1e3 / min(ns):11.1f}{1e3 / statistics.median(ns):11.1f}"
    if "share" in counters:
        text += f"{'':22}{statistics.median(counters['share']):8.1%}"
    print(text)
for name, counters in lines.items():
    if "bytes_per_element" in counters:
        print(f"\n{name:<28}{counters['bytes_per_element'][0]:.0f} B an element: bodies "
              f"{counters['of_bodies'][0]:.0f}, contact {counters['of_contact'][0]:.0f}")
PYTHON
