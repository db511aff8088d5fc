// A second value of diffuse: light from behind.
#include "stage.inc"
light_source { <4, 1, 6> rgb <1, .7, .4> }
disc { <-1.2, .5, 0>, <.2, .1, -1>, .7 pigment { rgb .8 } finish { diffuse .5, .4 } }
disc { <.5, .5, 0>, <.2, .1, -1>, .7 pigment { rgb .8 } finish { diffuse .5 } }
sphere { <1.7, .2, .5>, .5 pigment { rgb <.9, .6, .3> } finish { diffuse .2, .7 brilliance 2 } }
