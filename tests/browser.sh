# Sourced by the tests that open a page of ours in headless Chromium. Needs $work, a folder to write to.

fail() {
  echo "FAILED: $1" >&2
  exit 1
}

browse() {  # browse PAGE SIZE OPTION...
  timeout 100 chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync \
    --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir="$work/profile" \
    --enable-logging=stderr --window-size="$2" "${@:3}" "file://$1"
}

# body_of NAME PAGE SIZE WANTED [DRIVER]: the <body> tag of the page once it says data-WANTED or an error; the page
# is left in $work/page.html. Chromium writes a page at its load event, which page_held.js puts off till then: a
# budget of virtual time would run out on a busy machine before the browser has rendered a frame.
body_of() {
  local held=$work/held.html
  { cat "$2"; echo "<script>const WANTED = \"$4\";"; cat "$(dirname "$0")/page_held.js" "${@:5}"; echo '</script>'; } >"$held"
  browse "$held" "$3" --dump-dom >"$work/page.html" 2>"$work/log.txt" || fail "$1: chromium: $(tail -3 "$work/log.txt")"
  # Software that plays a graphics card remarks that copying a picture takes its time.
  if grep ':CONSOLE' "$work/log.txt" | grep -v 'GPU stall due to ReadPixels' >&2; then fail "$1: the console has messages"; fi
  grep -o '<body[^>]*>' "$work/page.html" | head -1
}

picture_of() {  # picture_of PAGE SIZE PNG, for somebody to look at: none where it would be removed
  if [[ $3 == "$work"/* ]]; then return; fi
  browse "$1" "$2" --virtual-time-budget=10000 --screenshot="$3" >/dev/null 2>&1
}
