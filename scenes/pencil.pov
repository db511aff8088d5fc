/* A pencil (pencil.inc): 17 surfaces, 9 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "pencil.inc"

camera { location <1.5, 9.5, -12> look_at <-.35, .2, .1> angle 50 right x * image_width / image_height }
background { rgb <.85, .84, .80> }
light_source { <-12, 16, -6>, rgb .95 }
light_source { <10, 9, -12>, rgb <.28, .30, .34> }

plane { y, 0 pigment { rgb <.80, .79, .74> } finish { ambient .16 diffuse .7 } }
object { Pencil_Lying translate -8.3 * x rotate 35 * y }
