#!/usr/bin/env bash
# bench/throughput.py in its quickest form: rows and hashes are kept, the same state is taken again, another
# one is refused and leaves everything as it was, and is taken when it is meant.
# usage: throughput_smoke.sh SOURCE_ROOT BUILD OUTPUT
set -euo pipefail

root=$1 build=$2 output=$3
throughput() {
  PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$root/bench/throughput.py" --quick --build "$build" \
    --output "$output" "$@"
}
rows() { cat -- "$output"/*cores.csv | wc -l; }

# Unless it is asked to record, it leaves the source as it is.
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/bench /usr/bin/python3 - <<'PYTHON'
import throughput
of = throughput.parsed
assert of([]).output == throughput.ROOT / "build/throughput", of([]).output
assert of([]).hashes == throughput.RECORDED / "hashes.csv"
assert of(["--record"]).output == throughput.RECORDED
PYTHON

rm -rf -- "$output"
throughput | tee "$output.log"
grep -q '^element-updates, 100 particles, 2 threads  *[0-9.]* M/s' "$output.log"
grep -q '^element-updates, 100 particles, 2 threads  *[0-9.]* M/s' "$output.log"
for line in 100,1,step 100,2,step 100,2,kernels 100,1,limit 100,2,limit 100,2,kernels/of_limit \
            100,1,graph 100,1,system/j2_return_map \
            100,1,memory/columns 100,1,startup 100,2,scaling thesis,2,run machine,2,fma machine,1,triad; do
  grep -qE "^$line,[^,]+,[0-9.e+-]+,[0-9.e+-]+,1,.*" "$output"/*cores.csv
done
hash=$(sed -n 's/^100,[0-9]*,[^,]*,\([0-9a-f]\{16\}\),.*/\1/p' "$output/hashes.csv")
[[ $hash && $(grep -c "^100,.*,$hash," "$output"/*cores.csv) -gt 20 ]]
first=$(rows) hashes=$(<"$output/hashes.csv")

throughput >"$output.log"
[[ $(rows) == $((2 * first - 1)) && $(<"$output/hashes.csv") == "$hashes" ]]

sed -i "s/,$hash,/,0123456789abcdef,/" "$output/hashes.csv"
if throughput >"$output.log" 2>&1; then exit 1; fi
grep -q "^throughput.py: 100: .* the state is $hash, recorded is 0123456789abcdef .*refused" "$output.log"
[[ $(rows) == $((2 * first - 1)) ]]
grep -q ,0123456789abcdef, "$output/hashes.csv"

# What bench/counts.py reads from a disassembly and from callgrind.
printf '%s\n' ob=/x/program 'fn=void pulvis::j2_return_map<A>()' '0x10 0 5' 'calls=1 0x99 0' '0x14 0 900' \
  '0x14 0 5' >"$output/callgrind.out"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/bench /usr/bin/python3 - "$output/callgrind.out" <<'PYTHON'
import sys
import counts
of = counts.operations
assert of("vfmadd231pd", "%ymm1,%ymm2,%ymm3") == 8 and of("vfnmsub132pd", "(%rax),%zmm2,%zmm3") == 16
assert of("vmulsd", "0x8(%rax),%xmm1,%xmm1") == 1 and of("vfmadd213sd", "%xmm1,%xmm2,%xmm3") == 2
assert of("sqrtpd", "%xmm0,%xmm1") == 2 and of("vdivpd", "%ymm0,%ymm1,%ymm2") == 4
assert of("vmaxpd", "%ymm0,%ymm1,%ymm2") == of("vmovapd", "%ymm0,%ymm1") == of("sub", "$8,%rsp") == 0
name = ("/x/program", "void pulvis::j2_return_map<A>()")
executed = counts.executions(sys.argv[1])
assert executed == {(*name, 0x10): 5, (*name, 0x14): 5}, executed
assert counts.figures(executed, 2) == {"instructions": 5, "flops": 0, "kernels/instructions": 5,
                                       "kernels/flops": 0}
PYTHON

throughput --accept-hash >"$output.log"
[[ $(rows) == $((3 * first - 2)) ]]
grep -q "^100,.*,$hash," "$output/hashes.csv"
