#!/bin/bash
# Probes a solid block and opens the report in headless Chromium: surfaces, parameters and links to the runs are there, nothing is
# loaded, and no error is raised.
#
# usage: probe_in_browser.sh PULVIS [FOLDER]
#   PULVIS   the program
#   FOLDER   where to leave the probe and a screenshot; without it they are removed
set -euo pipefail

pulvis=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
probed=${2:-$work}/probed

source "$(dirname "$0")/browser.sh"

"$pulvis" probe "$(dirname "$0")/helpers/solid-probe/probe.toml" -o "$probed" --jobs 2 --set 'particle.block.mesh.size="2.5 mm"' \
  >"$work/log.txt" 2>&1 || fail "the probe: $(tail -3 "$work/log.txt")"

body=$(body_of probe "$probed/report.html" 1200,2400 ready)
[[ $body == *'data-ready="1"'* && $body =~ data-points=\"([0-9]+)\" && ${BASH_REMATCH[1]} -ge 4 ]] || fail "too few yield points: $body"
[[ $body =~ data-drawn-lines=\"([0-9]+)\" && ${BASH_REMATCH[1]} -ge 4 ]] || fail "too few lines: $body"
link=$(grep -o 'href="isotropic%2Cdensity%3D1.006%2Cdirection%3D[0-9.]*/report.html"' "$work/page.html" | head -1) || fail "no link to a run"
[[ -n $link ]] || fail "no link to a run"
run=${link#href=\"}
run=$(/usr/bin/python3 -c 'import sys, urllib.parse; print(urllib.parse.unquote(sys.argv[1]))' "${run%\"}")
[[ -f $probed/$run ]] || fail "the link leads nowhere: $run"
picture_of "$probed/report.html" 1200,2400 "$probed/report.png"
echo "ok: probe report"
