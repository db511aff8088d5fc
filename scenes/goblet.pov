/* A goblet (goblet.inc): 1 surface of revolution, no trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "goblet.inc"

camera { location <0, 4.6, -8.2> look_at <.12, 1.60, 0> angle 27 right x * image_width / image_height }
background { rgb <.30, .10, .12> }
light_source { <-6, 9, -8>, rgb .95 }
light_source { <8, 5, -5>, rgb <.30, .28, .25> }

plane { y, 0 pigment { rgb <.36, .09, .11> } finish { ambient .15 diffuse .7 } }
object {
  Goblet
  pigment { rgb <.90, .60, .16> }
  finish { ambient .10 diffuse .58 phong 1 phong_size 35 metallic }
}
