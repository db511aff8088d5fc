#!/bin/sh
# A table of the gallery as POV-Ray renders its exports: for each scene the difference from trimray's own picture at chord
# errors h, h/4 and h/16. Takes some minutes; needs povray.
#   gallery_povray.sh TRIMRAY SCENES_FOLDER [SIZE [SCENE...]]
# h is a quarter of export's default. Exit status 1: a difference does not fall with h, or at h/16 more than 0.5 % of the
# pixels differ by more than 1/255.
set -u
trimray=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
scenes=$(cd "$2" && pwd)
size=${3:-256}
shift 2
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- teapot teapot_solid spoon pencil goblet crank1a crank allblade mechanical still_life
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
status=0

number() { awk -v name="$1" 'index($0, name) == 1 { sub(name, ""); print $1; exit }' out; }

printf '%-14s %10s %12s %9s %9s %14s\n' scene "chord error" rmse psnr ssim "over 1/255"
for scene in "$@"; do
    "$trimray" "$scenes/$scene.pov" "+W$size" "+H$size" -o own.png --quiet || exit 1
    h=$("$trimray" export "$scenes/$scene.pov" "+W$size" "+H$size" -o mesh.pov --verbose 2>&1 |
        awk '/chord error/ { print $NF / 4 }')
    last=1
    for part in 1 4 16; do
        error=$(awk "BEGIN { print $h / $part }")
        "$trimray" export "$scenes/$scene.pov" "+W$size" "+H$size" -o mesh.pov --chord-error "$error" --quiet || exit 1
        povray +Imesh.pov +Omesh.png "+W$size" "+H$size" -D -GA >log 2>&1 || { tail -n 5 log >&2; exit 1; }
        "$trimray" compare own.png mesh.png --share .995 >out
        within=$?
        rmse=$(number rmse)
        over=$(awk '/^over/ { print substr($4, 2), $5 }' out | tr -d ')')
        printf '%-14s %10.3g %12.3g %9.2f %9.6f %14s\n' "$scene" "$error" "$rmse" "$(number psnr)" "$(number ssim)" "$over"
        awk "BEGIN { exit !($rmse < $last) }" || { echo "  the difference does not fall"; status=1; }
        last=$rmse
    done
    [ "$within" = 0 ] || { echo "  too many pixels differ"; status=1; }
done
exit $status
