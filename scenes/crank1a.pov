/* A hand crank (crank1a.inc): 20 surfaces, 18 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "crank1a.inc"

camera { location <-3, 13, -15> look_at <0, 1.3, -.1> angle 40 right x * image_width / image_height }
background { rgb <.62, .60, .55> }
light_source { <-12, 18, -8>, rgb .95 }
light_source { <12, 10, -10>, rgb <.28, .29, .32> }

plane { y, 0 pigment { rgb <.58, .56, .50> } finish { ambient .15 diffuse .7 } }
object { Crank1a translate <-3.2, 1.05, 0> rotate 24 * y }
