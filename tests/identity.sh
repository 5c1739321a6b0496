#!/usr/bin/env bash
# The identity of a build: commit and sources. Two programs with different changes of their own differ, the same
# changes agree, and what is no source (results of benchmarks, notes) changes nothing.
# usage: identity.sh SOURCE_ROOT CMAKE
set -euo pipefail

root=$1 cmake=$2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
git init -q . && mkdir engine results
echo 'int a;' >engine/a.cpp && echo 'int b;' >engine/b.cpp && echo 1 >results/rows.csv
git add . && git -c user.name=t -c user.email=t@t commit -qm first
printf '%s\n' "$work/engine/a.cpp" "$work/engine/b.cpp" >"$work/files.txt"

identity() {
  "$cmake" -D "GIT=$(command -v git)" -D "SOURCE=$work" -D "FILES=$work/files.txt" -D VERSION=1 \
    -D "OUTPUT=$work/identity.cpp" -P "$root/cli/identity.cmake"
  sed -n 's/.*program_commit() { return "\(.*\)".*/\1/p' "$work/identity.cpp"
}
clean=$(identity)
[[ $clean =~ ^$(git rev-parse --short=12 HEAD)\+[0-9a-f]{12}$ ]]
echo 2 >>results/rows.csv && [[ $(identity) == "$clean" ]]
echo 'int c;' >>engine/a.cpp && one=$(identity) && [[ $one != "$clean" ]]
echo 'int d;' >>engine/a.cpp && other=$(identity) && [[ $other != "$one" && $other != "$clean" ]]
printf 'int a;\nint c;\n' >engine/a.cpp && [[ $(identity) == "$one" ]]
git mv engine/a.cpp engine/c.cpp && sed -i s/a.cpp/c.cpp/ files.txt && [[ $(identity) != "$one" ]]
