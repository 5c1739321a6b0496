"""Instructions and floating-point operations per element update, counted by callgrind.

  /usr/bin/python3 bench/counts.py [--case 100] [--steps 40]

Runs build/release/bench/throughput twice on one thread, for N and for 2N steps after the same preparation,
and takes the difference, which eliminates start-up and preparation. Callgrind counts how often each
instruction was executed, objdump identifies it. An addition, subtraction, multiplication, division or
square root of doubles is one operation per lane, a fused multiply-add two; comparisons, minima and moves
are none. Masked lanes count, since they are computed. Needs valgrind (Debian: valgrind) and objdump.
"""
import argparse
import collections
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = re.compile(r"\bpulvis::(trial_stress|elastic_stress|j2_return_map|internal_force)<")
OPERATION = re.compile(r"v?(?:(add|sub|mul|div|sqrt)|(fn?m(?:add|sub)(?:132|213|231)))([ps])d$")
LANES = {"x": 2, "y": 4, "z": 8}


class CannotCount(Exception):
    pass


def require_tools():
    for tool in ("valgrind", "objdump"):
        if shutil.which(tool) is None:
            raise CannotCount(f"{tool} is missing: apt-get install valgrind binutils")


def operations(mnemonic, operands):
    """Floating-point operations of one execution of an instruction."""
    match = OPERATION.match(mnemonic)
    if match is None:
        return 0
    one, _, packed = match.groups()
    lanes = max(LANES[r] for r in re.findall(r"%([xyz])mm", operands)) if packed == "p" else 1
    return lanes * (1 if one else 2)


def operations_by_address(program):
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program], check=True,
                             capture_output=True, text=True).stdout
    found = {}
    for address, mnemonic, operands in re.findall(r"^ +([0-9a-f]+):\t(\S+) *(.*)$", listing, re.M):
        if count := operations(mnemonic, operands):
            found[int(address, 16)] = count
    return found


def callgrind(program, case, steps, folder):
    """Execution counts by (object, function, address), number of elements, and total number of steps."""
    out = pathlib.Path(folder) / f"{steps}.out"
    done = subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-pos=no",
                           "--compress-strings=no", f"--callgrind-out-file={out}", program,
                           f"--count={case}:{steps}"], capture_output=True, text=True)
    if done.returncode != 0:
        raise CannotCount(f"the program failed under valgrind:\n{done.stdout}{done.stderr}")
    words = done.stdout.split()
    return executions(out), int(words[words.index("elements") + 1])


def executions(file):
    counts, where, function, inclusive = collections.Counter(), "", "", False
    for line in open(file, encoding="utf-8"):
        if line.startswith("ob="):
            where = line[3:-1]
        elif line.startswith("fn="):
            function = line[3:-1]
        elif line.startswith("calls="):
            inclusive = True  # the next line is the cost of the callee
        elif line.startswith("0x"):
            if not inclusive:
                address, _, cost = line.split()
                counts[where, function, int(address, 16)] += int(cost)
            inclusive = False
    return counts


def count(program, case, steps):
    """{"instructions": ..., "flops": ..., and both for "kernels/"}, each per element update."""
    require_tools()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = [pool.submit(callgrind, program, case, n, folder) for n in (steps, 2 * steps)]
        (short, elements), (long, _) = [run.result() for run in runs]
    long.subtract(short)
    return figures(long, steps * elements)


def figures(executed, updates):
    built = str(ROOT)  # only code built here does the computation
    known = {where: operations_by_address(where)
             for where in {key[0] for key in executed} if where.startswith(built)}
    sums = collections.Counter()
    for (where, function, address), times in executed.items():
        flops = times * known.get(where, {}).get(address, 0)
        for prefix in ("", "kernels/") if KERNELS.search(function) else ("",):
            sums[prefix + "instructions"] += times
            sums[prefix + "flops"] += flops
    return {name: value / updates for name, value in sums.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--case", default="100")
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--program", default=ROOT / "build/release/bench/throughput")
    options = parser.parse_args()
    try:
        result = count(options.program, options.case, options.steps)
    except CannotCount as error:
        sys.exit(f"counts.py: {error}")
    for name, value in result.items():
        print(f"{name:<24}{value:8.2f} an element-update")


if __name__ == "__main__":
    main()
