#!/usr/bin/env bash
# The tests of the lane type and of the kernels of particles, built for aarch64 (NEON) and run under qemu: kernels.sh [FOLDER]
# By hand. Debian packages: g++-aarch64-linux-gnu qemu-user googletest libeigen3-dev libxxhash-dev.
set -euo pipefail

source=$(dirname -- "$(readlink -f -- "$0")")/../..
place=${1:-$(mktemp -d)}
[[ -n ${1-} ]] || trap 'rm -rf -- "$place"' EXIT
mkdir -p "$place/include"
# The only headers of this machine: they hold no code of its architecture.
cp -u /usr/include/xxhash.h /usr/include/xxh3.h "$place/include"
google=/usr/src/googletest
compile=(aarch64-linux-gnu-g++ -std=c++20 -O1 -ffp-contract=off -fno-math-errno -fno-trapping-math -DXXH_STATIC_LINKING_ONLY -DXXH_IMPLEMENTATION -DFMT_HEADER_ONLY
         -DEIGEN_DONT_VECTORIZE -I"$source" -isystem /usr/include/eigen3 -isystem "$place/include"
         -isystem "$google/googletest/include" -isystem "$google/googlemock/include" -I"$google/googletest" -I"$google/googlemock")

cd -- "$source"
files=(tests/engine/{lane,portable_math,interruption}_test.cpp
       tests/systems/body/{j2,hourglass,time_step,element}_kernel_test.cpp
       tests/systems/contact/{contact,winding}_kernel_test.cpp
       tests/systems/observe/{cell_area,fragments,network}_kernel_test.cpp
       tests/systems/space/observe/cell_volume_kernel_test.cpp
       tests/systems/tools/{servo,surface,tool}_kernel_test.cpp
       engine/{portable_math,interruption}.cpp engine/files/xxh3.cpp systems/contact/surface_search.cpp scenes/tools/surface.cpp
       "$google"/googletest/src/gtest-all.cc "$google"/googlemock/src/{gmock-all,gmock_main}.cc)
objects=()
for file in "${files[@]}"; do
  objects+=("$place/$(basename -- "$file").o")
  if [[ ! -e ${objects[-1]} || $file -nt ${objects[-1]} ]]; then "${compile[@]}" -c "$file" -o "${objects[-1]}"; fi
done
aarch64-linux-gnu-g++ "${objects[@]}" -o "$place/kernels"
qemu-aarch64 -L /usr/aarch64-linux-gnu "$place/kernels"
