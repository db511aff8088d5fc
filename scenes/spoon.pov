/* A spoon (spoon.inc): 3 surfaces, no trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "spoon.inc"

camera { location <-6, 13, -15> look_at <-1.2, .5, -.4> angle 46 right x * image_width / image_height }
background { rgb <.18, .26, .36> }
light_source { <-18, 12, 6>, rgb .95 }
light_source { <10, 16, -14>, rgb <.30, .31, .34> }

plane { y, 0 pigment { rgb <.16, .28, .44> } finish { ambient .15 diffuse .7 } }
object {
  Spoon
  translate -8 * x
  rotate -22 * y
  pigment { rgb <.78, .78, .80> }
  finish { ambient .10 diffuse .52 phong .9 phong_size 40 metallic }
}
