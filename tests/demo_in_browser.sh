#!/bin/bash
# The demo as the launcher runs it, its own function and its own options, but with 25 of the 100 particles (4 s in place
# of a minute; they are pressed as the 100 are, at the same speed): its report finds every quality figure within its
# limit. With one point an element, as the scene has it, the hourglass energy is at 5% of 3% allowed.
#
# usage: demo_in_browser.sh PULVIS SOURCE_DIR
set -euo pipefail

pulvis=$1 source_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source "$(dirname "$0")/browser.sh"

# What demo() needs of its launcher: a place of its own, nothing to install, built already, and no pictures.
root=$work program=$work/program run_packages=()
ln -s "$source_dir/scenes" "$work/scenes"
cat >"$program" <<'END'
#!/bin/bash
if [[ $1 == run ]]; then exec "$PULVIS" "$@"; fi
END
chmod +x "$program"
export PULVIS=$pulvis
install_packages() { :; }
compile_program() { :; }
die() { fail "$1"; }
say() { fail "$1"; }
eval "$(sed -n '/^demo_run() {/,/^}/p;/^demo() {/,/^}/p' "$source_dir/pulvis")"

(demo --threads 1 --quiet --set output.frames=2 --set "packing[0].rows=5" --set "packing[0].columns=5" \
  --set 'tool.right.point=["50 mm", "0 mm"]' --set 'tool.top.point=["0 mm", "50 mm"]' \
  --set "stage.press.duration=2.8 ms" --set 'stage.press.move.top.displacement=["0 mm", "-5 mm"]') >"$work/run.txt" 2>&1 ||
  fail "the demo: $(tail -3 "$work/run.txt")"

body_of demo "$work/runs/demo/report.html" 1200,2000 ready >/dev/null
lead=$(grep -o '<p id="lead">[^<]*' "$work/page.html")
[[ $lead == *"Every quality value is within its limit."* ]] || fail "the demo's report: $lead"
if grep -q '"warnings"' "$work/runs/demo/summary.json"; then fail "the demo's summary has warnings"; fi
echo "ok: ${lead#*>}"
