#!/bin/sh
# From nothing to a picture: installs what is missing (Debian), builds a release, renders a scene into out/.
#   scenes/render.sh [SCENE.pov] [switches of trimray]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=.ci/setup.sh
. "$root/.ci/setup.sh"

scene=$root/scenes/still_life.pov
case ${1-} in
    *.pov) scene=$1; shift ;;
esac
[ -r "$scene" ] || { echo "$0: cannot read $scene" >&2; exit 3; }

need gcc libc6-dev make cmake libpng-dev libcjson-dev
build "$root/build" trimray -DCMAKE_BUILD_TYPE=Release -DTRIMRAY_TESTS=OFF

picture=$root/out/$(basename "$scene" .pov).png
mkdir -p "$root/out"
"$root/build/trimray" "$scene" --output "$picture" "$@"
echo "The picture: $picture"
