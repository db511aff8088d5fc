#!/bin/sh
# The report's page in headless Chromium, wide and narrow, light and dark: plots, slider, no error, no request.
#   tests/report_browser.sh [FOLDER]      installs what is missing (Debian's chromium, too), builds, makes a report
#                                         unless one is named; screenshots go to out/
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=.ci/setup.sh
. "$root/.ci/setup.sh"
need gcc libc6-dev make cmake libpng-dev libcjson-dev python3 chromium
mkdir -p "$root/out"

folder=${1-}
if [ ! "$folder" ]; then
    build "$root/build" trimray -DCMAKE_BUILD_TYPE=Release
    folder=$root/out/report
    "$root/build/trimray" report "$root/scenes/teapot.pov" "$root/scenes/goblet.pov" --quick --quiet -o "$folder"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The page as it is, and after its own script the report's numbers and the checks; errors are caught from the beginning.
python3 - "$folder" "$root/tests/report_browser.js" "$work/checked.html" <<'PY'
import sys
folder, script, out = sys.argv[1:]
page, numbers = open(f'{folder}/index.html').read(), open(f'{folder}/report.json').read().replace('</', '<\\/')
assert 'http://' not in page and 'https://' not in page, 'the page names an address'
caught = "<script>addEventListener('error', (e) => { document.title = e.message; throw e; });</script>"
checks = f'<script>const report = {numbers};\naddEventListener("load", () => {{\n{open(script).read()}\n}});</script>'
page = page.replace('<style>', caught + '<style>', 1)
open(out, 'w').write(page.replace('</body>', checks + '</body>', 1))
PY

failed=0
for look in 1280,3000:1:light 390,6000:1:narrow 1280,3000:0:dark; do
    size=${look%%:*} name=${look##*:} scheme=${look#*:}
    scheme=${scheme%%:*}
    # 0: dark, 1: light
    set -- chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --window-size="$size" \
        --blink-settings=preferredColorScheme="$scheme" --user-data-dir="$work/$name" --enable-logging=stderr \
        --host-resolver-rules='MAP * ~NOTFOUND'
    "$@" --virtual-time-budget=5000 --dump-dom "file://$work/checked.html" >"$work/$name.html" 2>"$work/$name.log" || true
    title=$(sed -n 's/.*<title>\(.*\)<\/title>.*/\1/p' "$work/$name.html" | head -1)
    console=$(grep -a 'CONSOLE' "$work/$name.log" || true)
    echo "$name: $title $console"
    [ "$title" = good ] && [ ! "$console" ] || failed=1
    "$@" --screenshot="$root/out/report-$name.png" "file://$folder/index.html" >/dev/null 2>&1 || failed=1
done
exit $failed
