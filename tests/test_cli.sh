#!/bin/sh
# The program as its users meet it: files, messages, exit statuses.
#   test_cli.sh TRIMRAY
set -u
# shellcheck source=tests/program.sh
. "$(dirname "$0")/program.sh"
cd "$work" || exit 1

is_silent() { [ ! -s err ] || fail "is not silent"; }
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
differ() { ! cmp -s "$1" "$2" || fail "$1 and $2 are the same"; }
absent() { [ ! -e "$1" ] || fail "there is a file $1"; }
# The header of a PNG file: width, height, bits, colour type (2: RGB, 6: RGBA).
png() {
    header=$(od -A n -t u1 -j 16 -N 10 "$1" | awk '{ print $3*256 + $4, $7*256 + $8, $9, $10 }')
    [ "$header" = "$2 $3 $4 $5" ] || fail "$1: $header, not $2 $3 $4 $5"
}

cat >two.pov <<'POV'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 right x up y angle 40 }
light_source { <3, 4, -5> rgb 1 }
sphere { <0, 0, 0>, 1 pigment { rgb <.4, .2, .1> } }
trimmed_nurbs <                          // the square [-2, 2] at z = 2, with a hole in the middle half
  order 2, 2
  knots_u { 0, 0, 1, 1 }  knots_v { 0, 0, 1, 1 }
  points 2, 2 { <-2, -2, 2>, <2, -2, 2>, <-2, 2, 2>, <2, 2, 2> }
  trim { <.25, .25>, <.75, .25>, <.75, .75>, <.25, .75> }
  pigment { rgb 1 }
>
plane { z, 10 pigment { rgb <0, 1, 1> } }
POV
cat >wrong.pov <<'POV'
#version 3.7;
sphere { <0, 0, 0>, 1 }
sphere { <0, 0, 0> 1, }
sphere { <1, 2 }
POV
cat >plain.pov <<'POV'
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { <0, 0, 5>, 1 pigment { rgb 1 } finish { ambient 1 } }
POV
# Two mirrors face to face: every pixel is 200 reflections.
cat >endless.pov <<'POV'
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 200 adc_bailout 1e-30 }
light_source { 0 rgb 1 }
plane { z, 1 pigment { rgb 1 } finish { reflection .99 } }
plane { z, -1 pigment { rgb 1 } finish { reflection .99 } }
POV

test=the_picture_lies_beside_the_scene
mkdir folder && cp two.pov folder
run folder/two.pov +W40 +H30
ends_with 0; is_silent; png folder/two.png 40 30 8 2

test=the_limit_of_loops_can_be_set
echo '#declare I = 0; #while (I < 1000) #declare I = I + 1; #end sphere { 0, 1 }' >loop.pov
run check loop.pov --max-steps 10
ends_with 1
run check loop.pov --max-steps 2000
ends_with 0

test=a_picture_can_go_anywhere
run two.pov +W40 +H30 +O-
ends_with 0; same out folder/two.png
run two.pov Width=40 Height=30 +Oother
ends_with 0; same other.png folder/two.png
mkdir pictures
run two --width 40 --height=30 --output pictures/
ends_with 0; same pictures/two.png folder/two.png
run two.pov +W40 +H30 -F
ends_with 0; absent two.png

test=any_number_of_threads_gives_the_same_bytes
for n in 1 2 5; do
    run two.pov +W97 +H61 "+WT$n" "+Othreads$n.png"
    ends_with 0; same threads1.png "threads$n.png"
done

test=pictures_have_the_bits_that_are_asked_for
run two.pov +W8 +H8 +FN16 +UA +Odeep.png
ends_with 0; png deep.png 8 8 16 6

test=a_part_of_the_picture_leaves_the_rest_black
run plain.pov +W40 +H40 +Ofull.png
run plain.pov +W40 +H40 +SC1 +EC40 +SR0.0 +ER1.0 +Oall.png
same full.png all.png
run plain.pov +W40 +H40 +SC20 +Opart.png
ends_with 0; png part.png 40 40 8 2; differ full.png part.png
run plain.pov +W40 +H40 +SC30 +EC20 +Onone.png
ends_with 2; absent none.png

test=a_declared_number_reaches_the_scene
echo 'sphere { z*5, Size pigment { rgb 1 } finish { ambient Glow + clock } }' >declared.pov
run declared.pov +W20 +H20 Declare=Size=1 --declare Glow=.25 +K.25 +Odeclared.png
ends_with 0
sed -i 's/Size/1/; s/Glow + clock/0.5/' declared.pov
run declared.pov +W20 +H20 +Oplain.png
same declared.png plain.png

test=included_files_are_found_beside_the_scene_and_by_the_library_path
echo '#declare Radius = 1;' >folder/radius.inc
echo '#include "radius.inc" sphere { z*5, Radius }' >folder/includes.pov
mkdir library && echo '#declare Radius = undefined;' >library/radius.inc
run check folder/includes.pov
ends_with 0
run check folder/includes.pov +Llibrary
ends_with 1; says "library/radius.inc:1:"

test=a_wrong_command_line_is_refused
for wrong in +Wabc +W0 +Q99 +FT +A2.0 --nonsense --stats Colour=2 'second scene'; do
    run two.pov "$wrong"
    ends_with 2; says "$wrong: "; absent two.png
done
run
ends_with 2; says "no scene given"
run shoot two.pov
ends_with 2; says "--rays"

test=help_and_version_are_printed
run --help
ends_with 0; is_silent; prints "--flattening"; prints "+WTN, --threads N"; prints "default 800"
run --version
ends_with 0; prints "trimray "

test=a_wrong_scene_gives_messages_with_places_and_no_picture
cp folder/two.png wrong.png
run wrong.pov +W8 +H8
ends_with 1; says "wrong.pov:3:"; says "wrong.pov:4:"; same wrong.png folder/two.png
run check wrong.pov
ends_with 1; says "wrong.pov:3:"

test=files_that_cannot_be_had_are_named
run nowhere.pov
ends_with 3; says "cannot read nowhere.pov: No such file"
run folder
ends_with 3; says "cannot read folder: Is a directory"
run two.pov +W8 +H8 +Ono/where.png
ends_with 3; says "cannot write no/where.png: No such file"
run shoot two.pov --rays nowhere.bin
ends_with 3; says "cannot read nowhere.bin"
run two.pov +W8 +H8 -F --stats no/where.json
ends_with 3; says "cannot write no/where.json"

test=check_says_what_the_scene_has
run check two.pov
ends_with 0; is_silent; prints "primitives"; prints "sphere"; prints "control points           4"; prints "left out:"
prints "division by weights: surfaces that are polynomial (1 of 1)"
absent two.png

test=instances_are_seen_but_not_copied
echo '#declare Ball = sphere { 0, 1 }
object { Ball } union { object { Ball translate x*3 } object { Ball scale 2 } } sphere { y*9, 1 }' >instances.pov
run check instances.pov
ends_with 0; prints "    sphere                 4 (of 2 distinct)"

# The hits by hand: the sphere; through the hole to the plane; the patch, (u, v) = (.875, .5); the sphere from within, the
# direction not of unit length; nothing.
cat >rays.txt <<'TXT'
# origin, direction
0 0 -5  0 0 1
0, 0, 1.5, 0, 0, 1

1.5 0 0  0 0 1
0 0 0  0 3 0   # a comment
0 0 -5  0 0 -1
TXT
test=shoot_finds_the_hits_of_rays
run shoot two.pov --rays rays.txt --out hits.txt
ends_with 0; is_silent
awk '{ for (i = 4; i <= 6; i++) $i = $i < 0 ? -$i : $i + 0        # either side
       uv = $7 == 1 ? sprintf("%.9g %.9g", $2, $3) : "- -"
       printf "%.9g %s %.9g %.9g %.9g %d\n", $1, uv, $4, $5, $6, $7 }' hits.txt >found
cat >expected <<'TXT'
4 - - 0 0 1 0
8.5 - - 0 0 1 2
2 0.875 0.5 0 0 1 1
1 - - 0 1 0 0
inf - - 0 0 0 -1
TXT
same found expected
tested=$(awk '{ printf "%d", ($8 > 0) }' hits.txt)
[ "$tested" = 01100 ] || fail "rays that tested leaves: $tested"

# The gallery's models lie about the origin, above y = 0. 600 rays are three blocks.
test=shoot_finds_the_same_hits_with_any_number_of_threads
awk 'BEGIN { srand(1); for (i = 0; i < 600; i++) print 0, 9, -16, rand() * 8 - 4, rand() * 6 - 9, rand() * 8 + 12 }' >many.txt
for scene in "$scenes"/*.pov; do
    for method in paper certain; do
        for n in 1 2 5; do
            run shoot "$scene" --method $method --rays many.txt --out "shot$n.txt" "+WT$n"
            ends_with 0; same shot1.txt "shot$n.txt"
        done
        grep -qv '^inf' shot1.txt || fail "no ray hits $scene"
    done
done

test=binary_rays_and_hits_are_the_same_numbers
zero='\0\0\0\0\0\0\0\0'
printf %b "$zero$zero"'\0\0\0\0\0\0\0024\0300' "$zero$zero"'\0\0\0\0\0\0\0360\0077' >one.bin   # 0 0 -5, 0 0 1
run shoot two.pov --rays one.bin --out one.hits
ends_with 0
od -A n -v -t f8 -w64 one.hits | awk '{ print $1, $2, $3, $4, $5, $6, $7, $8 }' >binary
run shoot two.pov --rays - <rays.txt
ends_with 0; same out hits.txt
head -n 1 hits.txt >text
same binary text

test=malformed_rays_are_errors_with_their_place
printf '0 0 -5 0 0 1\n0 0 -5 0 0\n' >short.txt
run shoot two.pov --rays short.txt
ends_with 1; says "short.txt:2:11: error: expected 6 numbers, found 5"
echo '0 0 x 0 0 1' >word.txt
run shoot two.pov --rays word.txt
ends_with 1; says "word.txt:1:5: error: expected a number"
echo '0 0 0 0 0 0' >still.txt
run shoot two.pov --rays still.txt
ends_with 1; says "still.txt:1:1: error: the direction is zero"
head -c 40 one.bin >cut.bin
run shoot two.pov --rays cut.bin --out cut.hits
ends_with 1; says "cut.bin: 40 bytes are not a whole number of rays"; absent cut.hits

test=statistics_tell_what_was_done_and_left_out
run two.pov +W40 +H30 +WT2 -F --stats two.json
ends_with 0
for key in parse_seconds prep_seconds trace_seconds write_seconds threads peak_mb rays bv_intersections \
    light_bv_intersections leaf_tests nurbs_tests nurbs_seconds nurbs_hits reported_hits newton_iterations newton_jitters \
    certificates fallbacks surfaces trims shadow_rays reflected_rays transmitted_rays left_out; do
    grep -q "\"$key\":" two.json || fail "no $key"
done
grep -q '"rays":.1200,' two.json || fail "rays are not 1200"
grep -q '"surfaces":.1,' two.json || fail "surfaces are not 1"
grep -q '"shadow_rays":.[1-9]' two.json || fail "no shadow rays"
grep -q 'secondary rays: no texture reflects' two.json || fail "secondary rays are not left out"
run plain.pov +W8 +H8 -F --stats plain.json
grep -q 'NURBS: the scene has no such surface' plain.json || fail "NURBS is not left out"
grep -q 'shadow rays: no light asks' plain.json || fail "shadow rays are not left out"
run shoot two.pov --rays rays.txt --out hits2.txt --stats shoot.json
ends_with 0; same hits.txt hits2.txt
grep -q '"rays":.5,' shoot.json || fail "rays are not 5"

test=a_surface_that_no_ray_reaches_is_not_prepared
sed '/points 2, 2/s/, 2>/, -9>/g' two.pov >behind.pov
run behind.pov +W40 +H30 +Q1 -F --stats behind.json
ends_with 0
grep -q '"leaf_tests":.0,' behind.json || fail "the surface was tested"
grep -q 'preparation: surfaces that no ray reached' behind.json || fail "the surface was prepared"

test=an_interrupt_keeps_what_was_finished
"$trimray" endless.pov +W1000 +H1000 +WT2 --stats endless.json >out 2>err &
sleep 1
kill -TERM $!
wait $!
status=$?
ends_with 130; png endless.png 1000 1000 8 2
grep -q '"interrupted":.true' endless.json || fail "the statistics do not tell"

end_of_tests
