#!/bin/sh
# Export and comparison, from outside: what is exported reads back as the same scene; meshes come near to surfaces as they
# must; what compare says and how it ends.
#   test_export.sh TRIMRAY
set -u
# shellcheck source=tests/program.sh
. "$(dirname "$0")/program.sh"
size="+W120 +H90"

works() { run "$@"; [ "$status" = 0 ] || fail "$* ends with $status"; }
number() { awk -v name="$1" 'index($0, name) == 1 { sub(name, ""); print $1 }' "$work/out"; }
less() { awk "BEGIN { exit !($1 < $2) }" || fail "$3: $1 is not less than $2"; }

# Scenes without surfaces: the same picture, whatever way the text took.
cd "$tests/povray" || exit 1
for scene in *.pov; do
    test="$scene exported and read again"
    rm -f "$work"/*.pov "$work"/*.png
    works "$scene" $size -o "$work/a.png" --quiet
    works export "$scene" $size -o "$work/b.pov" --quiet
    works "$work/b.pov" $size -o "$work/b.png" --quiet
    works compare "$work/a.png" "$work/b.png" --share .999
done

# Scenes with surfaces: the difference falls with the chord error, for ourselves and, if it is there, for POV-Ray.
cd "$tests/export" || exit 1
povray=$(command -v povray)
for scene in plate instances; do
    works $scene.pov $size "+L$tests/../scenes" -o "$work/a.png" --quiet
    last=1
    for error in .02 .005 .00125; do
        test="$scene.pov as meshes within $error"
        works export $scene.pov $size "+L$tests/../scenes" -o "$work/b.pov" --chord-error $error --quiet
        works "$work/b.pov" $size -o "$work/b.png" --quiet
        works compare "$work/a.png" "$work/b.png" --share .99
        rmse=$(number rmse)
        less "$rmse" "$last" "the difference"
        last=$rmse
        [ -n "$povray" ] || continue
        (cd "$work" && "$povray" +Ib.pov +Oc.png $size -D -GA >out 2>err) || fail "povray does not render it"
        works compare "$work/a.png" "$work/c.png" --share .99
        works compare "$work/b.png" "$work/c.png" --share .999
    done
    less "$(number rmse)" .005 "$scene.pov: the difference from POV-Ray at last"
done
[ -n "$povray" ] || echo "no povray: not compared with it"

cat >"$work/solids.pov" <<'POV'
sphere { <0, 0, 3>, 1 }  box { -1, 1 translate 3*x }  torus { 2, .5 }  cone { 0, 1, y, .5 scale <-1, 2, 1> }
cylinder { 0, y, .3 open }  disc { 0, y, 3, 1 }  plane { y, -5 }  plane { x, -5 }
mesh { triangle { x, y, z } }  difference { sphere { 0, 1 } box { 0, 1 } }
POV
cd "$work" || exit 1

test="planes and what compounds make of their parts have no triangles"
run export solids.pov -o solids.obj --chord-error .01
ends_with 0
says "2 plane left out"
says "1 intersection left out"
# Two triangles to a box's face, and a group for each shape.
[ "$(grep -c '^g ' solids.obj)" = 7 ] || fail "$(grep -c '^g ' solids.obj) groups, not 7"
[ "$(awk '/^g/ { box = /box/ } /^f/ && box' solids.obj | wc -l)" = 12 ] || fail "a box has not 12 triangles"

test="OBJ: points are on their solids, and triangles look outwards"
awk '
    function off(d) { return d > 1e-9 || d < -1e-9 }
    /^g/ { shape = $2 }
    /^v / {
        n++; x[n] = $2; y[n] = $3; z[n] = $4
        if (shape ~ /^sphere/ && off(sqrt($2*$2 + $3*$3 + ($4 - 3)^2) - 1)) bad++
        if (shape ~ /^torus/ && off(sqrt((sqrt($2*$2 + $4*$4) - 2)^2 + $3*$3) - .5)) bad++
        if (shape ~ /^cone/ && $2*$2 + $4*$4 > 1e-18 && $3 > 1e-9 && $3 < 2 && off(sqrt($2*$2 + $4*$4) - 1 + $3/4)) bad++
    }
    /^vn/ { m++; nx[m] = $2; ny[m] = $3; nz[m] = $4 }
    /^f/ {
        split($2, p, "/"); split($3, q, "/"); split($4, r, "/"); a = p[1]; b = q[1]; c = r[1]
        ux = x[b] - x[a]; uy = y[b] - y[a]; uz = z[b] - z[a]; vx = x[c] - x[a]; vy = y[c] - y[a]; vz = z[c] - z[a]
        if ((uy*vz - uz*vy)*nx[a] + (uz*vx - ux*vz)*ny[a] + (ux*vy - uy*vx)*nz[a] <= 0) bad++
        if (shape ~ /^cone/ && (uy*vz - uz*vy)*x[a] + (uz*vx - ux*vz)*(y[a] - 1) + (ux*vy - uy*vx)*z[a] <= 0) bad++
    }
    END { exit !(bad == 0 && n > 1000) }
' solids.obj || fail "some are not"

test="STL: as many triangles as it says, and as there are in OBJ"
works export solids.pov -o solids.stl --chord-error .01 --quiet
count=$(od -A n -t u4 -j 80 -N 4 solids.stl | tr -d ' ')
[ "$count" = "$(grep -c '^f' solids.obj)" ] || fail "$count triangles"
[ "$(wc -c <solids.stl)" = $((84 + 50 * count)) ] || fail "$(wc -c <solids.stl) bytes"

test="what export is not given, or cannot do"
run export solids.pov
ends_with 2
says "export needs -o FILE"
run export solids.pov -o solids.txt
ends_with 2
says "export writes .pov, .obj or .stl, not solids.txt"
run export solids.pov -o nowhere/solids.pov
ends_with 3
run export solids.pov -o solids.pov.obj --chord-error 0
ends_with 2

test="compare: the same picture"
works solids.pov +W40 +H30 -o one.png --quiet
run compare one.png one.png
ends_with 0
prints "rmse         0"
prints "psnr         inf"
prints "ssim         1.000000000"
prints "over 1/255   0 (0.0000 %)"

test="compare: another picture, and its bounds"
works "$tests/povray/object_sphere.pov" +W40 +H30 -o two.png --quiet
run compare one.png two.png --diff diff.png
ends_with 1
prints ": no"
[ -s diff.png ] || fail "no picture of the differences"
run compare one.png two.png --within 255
ends_with 0
run compare one.png two.png --share 0 --quiet
ends_with 0
[ ! -s out ] || fail "--quiet prints"

test="compare: what cannot be compared"
works solids.pov +W41 +H30 -o three.png --quiet
run compare one.png three.png
ends_with 1
says "the pictures differ in size: 40 x 30 and 41 x 30"
run compare one.png none.png
ends_with 3
run compare one.png
ends_with 2
says "compare needs two pictures"

end_of_tests
