#!/usr/bin/env bash
# The Debian packages, unpacked somewhere else, hold a program that runs, and all that its scenes read:
# package.sh BUILD_DIR
set -euo pipefail
build=$(readlink -f -- "$1")
place=$(mktemp -d)
trap 'rm -rf -- "$place"' EXIT

cpack --config "$build/CPackConfig.cmake" -G DEB -B "$place" >"$place/log" || { cat "$place/log"; exit 1; }
dpkg-deb -x "$place"/pulvis_*.deb "$place/root"
depends=$(dpkg-deb -f "$place"/pulvis_*.deb Depends)
for library in libtbb12 libhdf5 libfcl libxxhash; do
  [[ $depends == *$library* ]] || { echo "does not depend on $library"; exit 1; }
done

[[ $depends != *mpi* ]] || { echo "depends on MPI: $depends"; exit 1; }

usr=$place/root/usr
[[ ! -e $usr/lib/pulvis/libpulvis_mpi.so ]]
libraries=$(ldd "$usr/bin/pulvis")
[[ $libraries == *"libpulvis_core.so => $usr/bin/../lib/pulvis/"* ]] ||
  { echo "takes another core library:"; echo "$libraries"; exit 1; }
cd -- "$place"
failed=0
for scene in "$usr"/share/pulvis/scenes/{afm,basic,compaction-3d,shear,extreme}/*.toml; do
  "$usr/bin/pulvis" check "$scene" >"$place/log" 2>&1 || { cat "$place/log"; failed=1; }
done
"$usr/bin/pulvis" run "$usr/share/pulvis/scenes/compaction/unit-cell.toml" -o run --quiet
test -s run/report.html
if [[ -d $usr/lib/python3/dist-packages/pulvis ]]; then  # its module, over its own library: the same bits
  PYTHONPATH=$usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "$usr" <<'PYTHON'
import sys
import pulvis
assert pulvis.__file__.startswith(sys.argv[1]), pulvis.__file__
pulvis.Scene(f"{sys.argv[1]}/share/pulvis/scenes/compaction/unit-cell.toml").simulation(folder="module").run()
# The loader takes the library of the best instruction set, which may lie in a folder below.
cores = {line.split()[-1] for line in open("/proc/self/maps") if line.rstrip().endswith("/libpulvis_core.so")}
assert len(cores) == 1 and cores.pop().startswith(f"{sys.argv[1]}/lib/pulvis/"), cores
hashes = [pulvis.open(run).summary["state_hash"] for run in ("run", "module")]
assert hashes[0] == hashes[1], hashes
PYTHON
fi
test -s "$usr/share/doc/pulvis/scene.schema.json"
if [[ -e $build/lib/libpulvis_mpi.so ]]; then  # in a package of its own, whose library the program finds
  depends=$(dpkg-deb -f "$place"/pulvis-mpi_*.deb Depends)
  for package in "pulvis (= " openmpi-bin libopenmpi3; do
    [[ $depends == *$package* ]] || { echo "pulvis-mpi does not depend on $package: $depends"; exit 1; }
  done
  dpkg-deb -x "$place"/pulvis-mpi_*.deb "$place/mpi"
  [[ $(cd "$place/mpi" && find . -type f) == *./usr/lib/*pulvis/libpulvis_mpi.so ]]
  printf '#!/bin/sh\nexit 3\n' >mpirun && chmod +x mpirun
  ranks() {
    local status=0
    PATH=$place:$PATH "$usr/bin/pulvis" run "$usr/share/pulvis/scenes/compaction/unit-cell.toml" -o ranks --ranks 2 || status=$?
    echo "$status"
  }
  [[ $(ranks 2>"$place/log") == 4 ]] && grep -q pulvis-mpi "$place/log"
  cp -r "$place/mpi/usr/." "$usr"
  [[ $(ranks) == 3 ]]  # mpirun's
fi
exit "$failed"
