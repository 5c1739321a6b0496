#!/usr/bin/env bash
# Reads run.vtkhdf and tools.vtkhdf of runs with the VTK of Debian 13 (9.3, the first that reads a series), in a folder of its
# own: every frame has to have the bits of run.h5. Debian 12 has VTK 9.1, which reads the newest frame: tests/python/test_vtk_hdf.py.
# By hand, as root.
#
# usage: vtk.sh RUN...
# FOLDER=...: where Debian 13 is installed (default /var/tmp/pulvis-vtk); it is kept, 1.5 GB
# Needs debootstrap. The first time takes a quarter of an hour.
set -euo pipefail

source=$(readlink -f -- "$(dirname -- "$0")/../..")
folder=$(readlink -m -- "${FOLDER:-/var/tmp/pulvis-vtk}")

mirror_of_this_machine() {
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' | grep -v security | head -1
}

inside() {
  chroot "$folder" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@"
}

if [[ $# == 0 ]]; then echo "usage: vtk.sh RUN..." >&2; exit 2; fi
if [[ ! -e $folder/root/installed ]]; then
  debootstrap --variant=minbase --include=ca-certificates trixie "$folder" "$(mirror_of_this_machine)"
  cp -- /etc/resolv.conf "$folder/etc/resolv.conf"
  inside apt-get -q update
  inside apt-get -q -y install --no-install-recommends python3-vtk9 python3-h5py
  touch -- "$folder/root/installed"
fi
cp -- "$source/tests/vtk_hdf.py" "$folder/root/vtk_hdf.py"
for run in "$@"; do
  place=$(mktemp -d -- "$folder/root/run-XXXXXX")
  cp -- "$run/run.h5" "$run"/*.vtkhdf "$place"
  inside python3 /root/vtk_hdf.py --vtk "${place#"$folder"}"
  rm -r -- "$place"
done
