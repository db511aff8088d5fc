/* A goblet (goblet.inc): 1 surface of revolution, no trims. */
#version 3.7;
global_settings { assumed_gamma 1 }
#include "goblet.inc"

camera { location <0, 4.4, -8.2> look_at <0, 1.58, 0> angle 28 right x * image_width / image_height }
background { rgb <.30, .10, .12> }
light_source { <-6, 9, -8>, rgb .95 }
light_source { <8, 5, -5>, rgb <.30, .28, .25> }

plane { y, 0 pigment { rgb <.42, .13, .15> } finish { ambient .15 diffuse .7 } }
object {
  Goblet
  pigment { rgb <.88, .66, .26> }
  finish { ambient .18 diffuse .55 phong .9 phong_size 50 metallic }
}
