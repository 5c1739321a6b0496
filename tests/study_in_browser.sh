#!/bin/bash
# Runs a small study and opens its report in headless Chromium: it must draw every curve, with band and bars over
# its seeds, a law of strength, main effects and the last frames, keep its tables inside the page, and raise no
# error, offline.
#
# usage: study_in_browser.sh PULVIS SCENE [FOLDER]
#   PULVIS   the program
#   SCENE    a scene of a compaction
#   FOLDER   where to leave the study and a screenshot; without it they are removed
set -euo pipefail

pulvis=$1 scene=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
study=${3:-$work}/study
mkdir -p "$study"

source "$(dirname "$0")/browser.sh"

cat >"$work/study.toml" <<TOML
scene = "$scene"
seeds = [1, 2]
[set]
"stage.press.duration" = "20 us"
"stage.press.move[0].displacement" = ["0 mm", "-0.4 mm"]
output.frames = 2
output.samples = 40
"contact.stiffness" = 0.5
[grid]
contact.friction = [0.1, 0.3]
[[fit]]
law = "ryshkewitch_duckworth"
series = "pressure/top"
density = "stress_ratio/lateral"
TOML
"$pulvis" study "$work/study.toml" -o "$study" >"$work/log.txt" || fail "the study: $(tail -3 "$work/log.txt")"

body=$(body_of study "$study/report.html" 1200,2400 ready)
[[ $body == *'data-ready="1"'* ]] || fail "not ready: $body"
[[ $body == *'data-drawn-lines="7"'* && $(grep -o 'class="curve" d="M' "$work/page.html" | wc -l) -eq 7 ]] ||
  fail "not 3 charts of 2 variations and one of a law: $body"
[[ $(grep -o 'class="mark" cx="[0-9]' "$work/page.html" | wc -l) -eq 4 ]] || fail "not 4 strengths at their law"
grep -q 'dense strength = ' "$work/page.html" || fail "no parameters of the law"
grep -q 'href="friction%3D0.1%2Cseed%3D2/report.html"' "$work/page.html" || fail "no link to a run"
[[ $body == *'data-effects="1"'* && $(grep -o 'class="effect" stroke-width="1.8"></path>' "$work/page.html" | wc -l) -eq 1 ]] || fail "no main effect: $body"
[[ $(grep -o 'class="error-bar" d="M' "$work/page.html" | wc -l) -ge 6 ]] || fail "no bars of the standard deviation"
[[ $(grep -o '<img src="data:image/png;base64,' "$work/page.html" | wc -l) -eq 4 ]] || fail "not a last frame of each run"
grep -q '<td class="number">[0-9.e-]* ± [0-9.e-]*</td>' "$work/page.html" || fail "no mean with its standard deviation"
grep -q '<th scope="col" class="number">top force at peak density \[N\]</th>' "$work/page.html" || fail "no unit in the head of a column"
grep -q 'class="beyond flag">⚠ [^<]* (limit ' "$work/page.html" || fail "no run is flagged with why"
grep -q '>Force on top against travel of top</h2>' "$work/page.html" && grep -q 'axial stress over yield stress σax/σy' "$work/page.html" ||
  fail "no names of the table where keys stood"
grep -q '<option value="n">nN</option>' "$work/page.html" || fail "no nN among the units"
[[ -f $study/friction=0.1,seed=2/report.html ]] || fail "the link leads nowhere"
body=$(body_of fits "$study/report.html" 1000,2400 fits "$(dirname "$0")/study_driver.js")
[[ $body == *'data-fits="1"'* ]] || fail "a table leaves the page, or its first column scrolls away: $body"
browse "$study/report.html" 1200,2400 --virtual-time-budget=10000 --screenshot="$study/report.png" >/dev/null 2>&1
/usr/bin/python3 - "$study/report.png" <<'PYTHON' || fail "a curve or its colour is missing"
import sys
from matplotlib.image import imread
pixels = (imread(sys.argv[1])[:, :, :3] * 255).round().astype(int).reshape(-1, 3)
for colour in ((0, 114, 178), (213, 94, 0)):  # of the two variations, frames of the legend aside
    assert (abs(pixels - colour).max(axis=1) < 8).sum() > 500, colour
PYTHON
echo "ok: study report"
