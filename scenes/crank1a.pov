/* A hand crank (crank1a.inc): 20 surfaces, 18 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "crank1a.inc"

camera { location <-4, 13, -15> look_at <-.1, 1.25, -.2> angle 36 right x * image_width / image_height }
background { rgb <.62, .60, .55> }
light_source { <-10, 16, 2>, rgb .95 }
light_source { <9, 12, -16>, rgb <.36, .36, .38> }

plane { y, 0 pigment { rgb <.58, .56, .50> } finish { ambient .15 diffuse .7 } }
object { Crank1a translate <-3.2, 1.05, 0> rotate 24 * y }
