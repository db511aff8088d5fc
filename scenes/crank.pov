/* A crankshaft (crank.inc): 73 surfaces, 64 trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "crank.inc"

camera { location <-4, 12, -17> look_at <-.1, 1.3, .1> angle 35 right x * image_width / image_height }
background { rgb <.40, .46, .44> }
light_source { <-16, 20, 2>, rgb .95 }
light_source { <8, 12, -18>, rgb <.36, .36, .38> }

plane { y, 0 pigment { rgb <.36, .44, .42> } finish { ambient .15 diffuse .7 } }
object {
  Crank
  translate -Crank_Length / 2 * y
  rotate 20 * y
  rotate -90 * z
  rotate -32 * y
  translate 1.8 * y
}
