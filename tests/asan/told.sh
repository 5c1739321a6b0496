#!/bin/sh
# told.sh REPORT PROGRAM MODE: the program must fail, and with this report.
out=$("$2" "$3" 2>&1) && { echo "nothing was reported: $out"; exit 1; }
echo "$out" | grep -q "$1" || { echo "another report than '$1': $out"; exit 1; }
