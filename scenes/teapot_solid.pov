/* A teapot of joined, trimmed surfaces (teapot_solid.inc): 10 surfaces, 5 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "teapot_solid.inc"

camera { location <-3.2, 6.4, -9.2> look_at <.2, 1.35, 0> angle 37 right x * image_width / image_height }
background { rgb <.70, .64, .56> }
light_source { <-7, 13, -9>, rgb .95 }
light_source { <10, 7, -7>, rgb <.26, .28, .34> }

plane { y, 0 pigment { rgb <.66, .58, .48> } finish { ambient .14 diffuse .7 } }
object {
  Teapot_Solid
  pigment { rgb <.16, .42, .46> }
  finish { ambient .12 diffuse .62 phong .9 phong_size 70 }
}
