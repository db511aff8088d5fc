// Spotlights: radius, falloff, tightness, defaults, transformed.
#declare No_light = 1;
#include "stage.inc"
light_source { <-3, 4, -3> rgb 1 spotlight point_at <-1, 0, 0> radius 8 falloff 14 }
light_source { <3, 4, -2> rgb <.9, .5, .3> spotlight point_at <1, -.5, 0> radius 12 falloff 13 tightness 20 }
light_source { <0, 3, 0> rgb <.2, .3, .8> spotlight point_at 0 tightness 8 translate <0, 0, 1> }
sphere { <-.9, .1, 0>, .6 pigment { rgb .9 } finish { phong .6 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> pigment { rgb .8 } }
