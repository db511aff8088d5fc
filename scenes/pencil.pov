/* A pencil (pencil.inc): 17 surfaces, 9 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "pencil.inc"

camera { location <-2.2, 7.5, -9.5> look_at <-.95, .1, -.35> angle 50 right x * image_width / image_height }
background { rgb <.72, .74, .72> }
light_source { <-4, 14, -7>, rgb .95 }
light_source { <12, 9, 2>, rgb <.25, .27, .32> }

plane { y, 0 pigment { rgb <.62, .66, .64> } finish { ambient .14 diffuse .7 } }
object { Pencil_Lying translate -Pencil_Length / 2 * x rotate -28 * y }
