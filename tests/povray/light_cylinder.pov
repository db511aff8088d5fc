// Cylindrical lights: beams with a soft edge.
#declare No_light = 1;
#include "stage.inc"
light_source { <-3, 4, -3> rgb 1 cylinder point_at <-1, 0, 0> radius .5 falloff .9 }
light_source { <3, 4, -2> rgb <.9, .5, .3> cylinder point_at <1, -.5, 0> radius .3 falloff 1.2 tightness 2 }
light_source { <0, 6, 3> rgb .15 }
sphere { <-.9, .1, 0>, .6 pigment { rgb .9 } finish { phong .6 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> pigment { rgb .8 } }
