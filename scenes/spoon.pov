/* A spoon (spoon.inc): 3 surfaces, no trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "spoon.inc"

camera { location <0, 15, -19> look_at <.1, .5, -.2> angle 43 right x * image_width / image_height }
background { rgb <.18, .26, .36> }
light_source { <-14, 22, 8>, rgb .9 }
light_source { <12, 14, -16>, rgb <.35, .36, .38> }

plane { y, 0 pigment { rgb <.20, .32, .46> } finish { ambient .15 diffuse .7 } }
object {
  Spoon
  translate -8 * x
  rotate 28 * y
  pigment { rgb <.80, .80, .82> }
  finish { ambient .16 diffuse .5 phong .9 phong_size 45 metallic }
}
