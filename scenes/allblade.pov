/* The rotor of a turbine (allblade.inc): 351 surfaces, no trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "allblade.inc"

camera { location <0, 15, -13> look_at <0, .2, -.25> angle 29 right x * image_width / image_height }
background { rgb <.24, .30, .40> }
light_source { <-12, 18, -4>, rgb .95 }
light_source { <12, 8, -10>, rgb <.34, .32, .28> }

plane { y, -.9 pigment { rgb <.22, .29, .40> } finish { ambient .15 diffuse .7 } }
object { Allblade }
