#!/usr/bin/env bash
# Pulvis on Debian 13 (trixie), in a folder of its own: installs Debian 13 there, builds the last commit as users do, with its
# compiler and libraries, runs the demo, imports the Python package, builds the documentation, runs the tests of the engine, and
# compares the state hashes of runs in 2D, of levers and of the demo with those of docs/trust.md and of this machine's program.
# By hand, as root.
#
# usage: trixie.sh [FOLDER [MIRROR]]
#   FOLDER   (default /var/tmp/pulvis-trixie) is kept: the next time only what has changed is installed and compiled
#   MIRROR   the Debian mirror; by default that of this machine's apt
# PROGRAM=FILE: this machine's program (build/release/cli/pulvis of this folder).
# Needs debootstrap. The first time takes an hour of two processors.
set -euo pipefail

source=$(readlink -f -- "$(dirname -- "$0")/../..")
folder=$(readlink -m -- "${1:-/var/tmp/pulvis-trixie}")
mirror=${2:-}
program=${PROGRAM:-$source/build/release/cli/pulvis}
tests=(libgtest-dev libgmock-dev libbenchmark-dev python3-jsonschema python3-meshio ccache)
# The demo with 25 of its 100 particles, and some of its time.
short=(--set "packing[0].rows=5" --set "packing[0].columns=5" --set 'tool.right.point=["50 mm", "0 mm"]'
       --set 'tool.top.point=["0 mm", "50 mm"]' --set 'stage.press.duration="0.2 ms"'
       --set 'stage.press.move.top.displacement=["0 mm", "-1 mm"]')

fail() { echo "FAILED: $1" >&2; exit 1; }
step() { printf '\n== %s (after %d s)\n' "$*" "$SECONDS"; }

mirror_of_this_machine() {
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' | grep -v security | head -1
}

inside() {  # COMMAND...: in Debian 13, in the folder of the sources
  chroot "$folder" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive CCACHE_DIR=/root/ccache bash -c 'cd /root/pulvis 2>/dev/null; "$@"' - "$@"
}

mounted=()
leave() {
  local place
  for place in "${mounted[@]}"; do umount -- "$place"; done
}

install_debian() {
  if [[ ! -e $folder/root/installed ]]; then
    debootstrap --variant=minbase --include=ca-certificates trixie "$folder" "${mirror:-$(mirror_of_this_machine)}"
    touch -- "$folder/root/installed"
  fi
  trap leave EXIT
  mount -t proc proc "$folder/proc" && mounted+=("$folder/proc")
  mount --bind /dev "$folder/dev" && mounted+=("$folder/dev")
  cp -- /etc/resolv.conf "$folder/etc/resolv.conf"
  inside apt-get -q update
  inside apt-get -q -y install --no-install-recommends git "${tests[@]}"
}

# The last commit, as a user clones it.
copy_sources() {
  if [[ ! -d $folder/root/pulvis/.git ]]; then git clone -q --no-hardlinks "$source" "$folder/root/pulvis"; fi
  git -C "$folder/root/pulvis" fetch -q "$source" HEAD
  git -C "$folder/root/pulvis" checkout -q --detach FETCH_HEAD
}

hash_of() { sed -n 's/.*"state_hash": "\([0-9a-f]\{16\}\)".*/\1/p' "$1/summary.json"; }

same_demo() {
  local here=$folder/tmp/demo-here
  inside ./pulvis demo "${short[@]}"
  if [[ ! -x $program ]]; then echo "no program on this machine to compare with: $program"; return; fi
  "$program" run "$source/scenes/compaction/regular-100.toml" -o "$here" --overwrite --quiet \
    --set element.formulation=four-point "${short[@]}"
  [[ $(hash_of "$here") == "$(hash_of "$folder/root/pulvis/runs/demo")" ]] ||
    fail "the demo: $(hash_of "$folder/root/pulvis/runs/demo"), here $(hash_of "$here")"
  echo "the demo has the hash of this machine: $(hash_of "$here")"
}

# The first column of hashes of builds_agree.sh are those of docs/trust.md.
same_hashes() {
  local name hash rest
  inside env THREADS="1 3" tests/builds_agree.sh . build/release/cli/pulvis | tee "$folder/tmp/agree.txt"
  while read -r name rest; do
    hash=$(sed 's/^threads [0-9]*  *\([0-9a-f]*\) .*/\1/' <<<"$rest")
    grep -qF "| $name | $hash |" <(sed 's/ | / |\n| /2' "$source/docs/trust.md") ||
      fail "$name: $hash is not in docs/trust.md"
  done < <(grep ' threads ' "$folder/tmp/agree.txt")
  echo "all hashes are those of docs/trust.md"
}

step "Debian 13 in $folder"
install_debian
copy_sources
step "./pulvis demo"
same_demo
step "the Python package"
inside env PYTHONPATH=build/release/python /usr/bin/python3 -c 'import pulvis; print(pulvis.Scene("scenes/compaction/unit-cell.toml"))'
step "./pulvis docs"
inside ./pulvis docs
step "tests of the engine, the schemas, the launcher"
inside cmake --preset release -DPULVIS_WERROR=OFF -DPULVIS_TESTS=ON -DPULVIS_BENCH=OFF -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
inside cmake --build --preset release --parallel "$(nproc)" --target pulvis_and_module test_engine
inside ctest --preset release -R '^(schema|launcher)$' || fail "tests"
inside build/release/tests/test_engine --gtest_brief=1 || fail "tests of the engine"
step "hashes"
same_hashes
step done
