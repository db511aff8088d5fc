// The camera within a torus and beside the inside of a cone.
#declare No_camera = 1;
#declare No_floor = 1;
#include "stage.inc"
camera { location <0, 0, -4> look_at <2.5, 0, -3> angle 75 }
light_source { <0, 0, -4> rgb .6 }
torus { 4, .8 pigment { checker rgb .9, rgb <.2, .4, .8> scale .5 } }
cone { <3.2, 0, -2.4>, .5, <1.4, 0, -3.7>, .1 open pigment { rgb <.9, .6, .2> } }
