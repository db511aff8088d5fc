// One surface in many places: scaled by 6 in one direction, mirrored, within unions, with textures of its own and without.
#version 3.7;
#include "nurbs.inc"
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 4, -9> look_at <0, .8, 0> angle 42 right x * image_width / image_height }
light_source { <-6, 9, -8>, rgb .8 }
light_source { <7, 5, -6>, rgb <.2, .25, .3> }
plane { y, 0 pigment { rgb <.4, .45, .4> } }
#declare Ring = trimmed_nurbs { Nurbs_Torus(.7, .3) }
#declare Pair = union {
  object { Ring }
  object { Ring rotate 90 * x pigment { rgb <.9, .8, .2> } }
  translate y
}
object { Ring scale <1, 6, 1> translate <-2.6, 1.9, 1> pigment { rgb <.2, .5, .8> } }
object { Pair scale <-1, 1, 1> pigment { rgb <.8, .3, .3> } finish { phong .8 } }
object { Pair rotate 40 * y scale .6 translate <2.4, 0, 0>
  texture { pigment { rgbf <.9, .95, .9, .8> } finish { reflection .1 phong .6 } } interior { ior 1.3 } }
