#!/usr/bin/env bash
# How the launcher builds: warnings are errors in CI and where a developer wants it, not for users; what a run needs includes the
# Python module.
#
# usage: launcher.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source_dir=$1 built=$2
root=$(mktemp -d)
trap 'rm -rf -- "$root"' EXIT
fail() { echo "FAILED: $1" >&2; exit 1; }

# What compile() of the launcher needs, and a cmake that only tells how it was called.
build=$root/build/release stamp=$root/build/release/launcher.stamp test_packages=()
compile_jobs() { echo 1; }
missing_packages() { echo all; }
best_instruction_set() { echo x86-64-v3; }
cmake() { printf '%s\n' "$*" >>"$root/called"; }
eval "$(sed -n '/^compile() {/,/^}/p; /^compile_program() {/,/^}/p' "$source_dir/pulvis")"

called_in() {  # called_in CI: the calls of cmake
  : >"$root/called"
  CI=$1 compile_program
  called=$(<"$root/called")
}
called_in ''
[[ $called == *-DPULVIS_WERROR=OFF* && $called != *-DPULVIS_WERROR=ON* ]] || fail "for a user: $called"
[[ $called == *"--target pulvis_and_module" ]] || fail "built for a user: $called"
called_in true
[[ $called == *-DPULVIS_WERROR=ON* && $called != *-DPULVIS_WERROR=OFF* ]] || fail "in CI: $called"
echo 'PULVIS_WERROR:BOOL=ON' >"$build/CMakeCache.txt"
called_in ''
[[ $called == *-DPULVIS_WERROR=ON* ]] || fail "for a developer: $called"
echo 'PULVIS_WERROR:BOOL=OFF' >"$build/CMakeCache.txt"
called_in ''
[[ $called == *-DPULVIS_WERROR=OFF* ]] || fail "for a user, again: $called"

inputs=$(ninja -C "$built" -t query pulvis_and_module)
[[ $inputs == *cli/pulvis* ]] || fail "the program is not built"
if grep -q '^PULVIS_PYTHON:[A-Z]*=AUTO' "$built/CMakeCache.txt" && [[ -e $built/python ]]; then
  [[ $inputs == *python/pulvis/_core* ]] || fail "the Python module is not built"
fi
echo ok
