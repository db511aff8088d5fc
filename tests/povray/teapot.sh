#!/bin/sh
# POV-Ray's own teapot (package povray-examples), unmodified: the nearer POV-Ray's triangles come to the patches, the fewer pixels
# of its picture differ from trimray's, which has no triangles.
#   teapot.sh TRIMRAY
set -eu
trimray=$(realpath "$1")
scene=/usr/share/doc/povray/examples/advanced/teapot
if [ ! -d "$scene" ] || ! command -v povray >/dev/null; then
    echo "skipped: it needs povray and povray-examples"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$scene"/* "$work"
cd "$work"
"$trimray" teapot.pov +W160 +H120 +Oours.png -V >/dev/null 2>&1
echo '| steps of a patch | pixels over 1/255 |'
echo '|---:|---:|'
before=19200
for steps in 2 3 4 5; do
    sed "s/flatness Flat_Enough u_steps 5 v_steps 5/flatness 0 u_steps $steps v_steps $steps/" "$scene/teapot.inc" >teapot.inc
    povray +Iteapot.pov +W160 +H120 +Otheirs.png -D -V -GA >/dev/null 2>&1
    over=$("$trimray" compare theirs.png ours.png | sed -n 's/^over 1\/255 *\([0-9]*\).*/\1/p')
    echo "| $((1 << steps)) | $over |"
    # half as long edges are a quarter as far from the surface; what differs is mostly along silhouettes, where pixels count
    [ "$((10 * over))" -le "$((7 * before))" ] || { echo "the difference does not fall"; exit 1; }
    before=$over
done
