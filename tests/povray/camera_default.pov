// No camera at all: at the origin, looking along z, right is 1.33 x.
#version 3.7;
global_settings { assumed_gamma 1 }
light_source { <-5, 8, -6> rgb 1 }
sphere { <0, 0, 5>, 1 pigment { rgb <.9, .3, .2> } }
box { <-2.9, -1.9, 6>, <-1.7, -.4, 7> pigment { rgb <.2, .5, .9> } }
plane { y, -2 pigment { checker rgb .8, rgb .4 } }
