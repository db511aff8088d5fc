// Parallel light, also of spotlights; the shadows of what stands beyond the light's plane.
#declare No_light = 1;
#include "stage.inc"
light_source { <-3, 6, -4> rgb .8 parallel point_at 0 }
light_source { <2, 1.2, -1> rgb <.5, .2, .1> parallel point_at <0, 0, 1> }
light_source { <0, 8, 1> rgb <.1, .2, .6> spotlight parallel point_at <.5, 0, 0> radius 6 falloff 9 }
sphere { <-.9, .1, 0>, .6 pigment { rgb .9 } finish { phong .6 } }
sphere { <1.7, 2.6, -3>, .3 pigment { rgb .9 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> pigment { rgb .8 } }
