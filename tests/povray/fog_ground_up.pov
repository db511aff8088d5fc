// Ground fog that thins out along another direction, given by a vector of any length.
#include "stage.inc"
fog { fog_type 2 distance 3 color rgb <.8, .8, .85> fog_offset -.5 fog_alt .7 up <-2, 1, .5> }
sphere { <-.7, .4, 0>, .7 pigment { rgb <.9, .3, .1> } }
cylinder { <3, -.5, 6>, <3, 4, 6>, .5 pigment { rgb <.2, .6, .3> } }
