/* The Utah teapot (teapot.inc): 32 surfaces, no trims. The one model that is the same as the paper's.
 * POV-Ray renders this scene, too, by cutting the patches into triangles. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "teapot.inc"

camera { location <1.8, 6.6, -9.2> look_at <.22, 1.24, 0> angle 38 right x * image_width / image_height }
background { rgb <.62, .66, .70> }
light_source { <-7, 13, -9>, rgb .95 }
light_source { <10, 7, -7>, rgb <.26, .28, .34> }

plane { y, 0 pigment { rgb <.56, .60, .64> } finish { ambient .14 diffuse .7 } }
object {
  Teapot
  pigment { rgb <.87, .74, .52> }
  finish { ambient .12 diffuse .62 phong .8 phong_size 60 }
}
