#!/bin/bash
# Probes a solid block in two and in three dimensions and opens the reports in headless Chromium: surfaces, parameters and links to
# the runs are there, the view in three dimensions turns and its points can be chosen, nothing is loaded, and no error is raised.
#
# usage: probe_in_browser.sh PULVIS [FOLDER]
#   PULVIS   the program
#   FOLDER   where to leave the probes and their screenshots; without it they are removed
set -euo pipefail

pulvis=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
folder=${2:-$work}
solid=$(cd "$(dirname "$0")/helpers/solid-probe" && pwd)

source "$(dirname "$0")/browser.sh"

probe() {  # probe FILE FOLDER OPTION...
  "$pulvis" probe "$1" -o "$2" --jobs 2 "${@:3}" >"$work/log.txt" 2>&1 || fail "the probe: $(tail -3 "$work/log.txt")"
}

at_least() {  # at_least NAME COUNT: of an attribute of $body
  [[ $body =~ $1=\"([0-9]+)\" && ${BASH_REMATCH[1]} -ge $2 ]] || fail "$1 is less than $2: $body"
}

linked() {  # linked PATTERN FOLDER: the page links to a run that matches
  local link run
  link=$(grep -o "href=\"$1/report.html\"" "$work/page.html" | head -1) || fail "no link to a run: $1"
  run=${link#href=\"}
  run=$(/usr/bin/python3 -c 'import sys, urllib.parse; print(urllib.parse.unquote(sys.argv[1]))' "${run%\"}")
  [[ -f $2/$run ]] || fail "the link leads nowhere: $run"
}

probed=$folder/probed
probe "$solid/probe.toml" "$probed" --set 'particle.block.mesh.size="2.5 mm"'
body=$(body_of probe "$probed/report.html" 1200,2400 ready)
[[ $body == *'data-ready="1"'* && $body != *data-shells* ]] || fail "in two dimensions: $body"
at_least data-points 4
at_least data-drawn-lines 4
linked 'isotropic%2Cdensity%3D1.006%2Cdirection%3D[0-9.]*' "$probed"
picture_of "$probed/report.html" 1200,2400 "$probed/report.png"

# With more directions in the deviatoric plane there are enough points for the models.
probed=$folder/probed-space
sed "s|\"dense-space.toml\"|\"$solid/dense-space.toml\"|; s|deviatoric = .*|deviatoric = 6|" "$solid/probe-space.toml" >"$work/probe-space.toml"
probe "$work/probe-space.toml" "$probed"
cat >"$work/turn.js" <<'END'
(async () => {
  for (let i = 0; i < 400 && !document.body.dataset.ready; ++i) await new Promise(done => setTimeout(done, 20));
  const canvas = document.getElementById("space"), told = document.getElementById("space-told"), seen = new Set([canvas.toDataURL()]);
  const press = key => { canvas.dispatchEvent(new KeyboardEvent("keydown", {key})); seen.add(canvas.toDataURL()); };
  ["ArrowLeft", "ArrowUp", "+", "h", "n"].forEach(press);
  const problems = [seen.size === 6 ? "" : `${seen.size} pictures of 6 differ`, told.querySelector("a") ? "" : `no link: ${told.textContent}`];
  document.body.dataset.turned = problems.filter(Boolean).join("; ") || "yes";
})().catch(error => { document.body.dataset.driverError = error; });
END
body=$(body_of "probe in three dimensions" "$probed/report.html" 1200,2400 turned "$work/turn.js")
[[ $body == *'data-turned="yes"'* && $body == *'data-shells="1"'* ]] || fail "in three dimensions: $body"
at_least data-points 10
at_least data-drawn-lines 10
for direction in direction%3D270 lode%3D60 shear_yz; do linked "isotropic%2Cdensity%3D1.006%2C$direction" "$probed"; done
picture_of "$probed/report.html" 1200,5000 "$probed/report.png"
echo "ok: probe reports"
