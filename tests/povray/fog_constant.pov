// Constant fogs: two of them, one that filters.
#include "stage.inc"
fog { distance 8 color rgb <.7, .75, .8> }
fog { fog_type 1 distance 20 color rgbft <.9, .6, .3, .3, .1> }
sphere { <-.7, .2, 0>, .7 pigment { rgb <.9, .3, .1> } }
sphere { <3, 1, 9>, 1.5 pigment { rgb <.2, .6, .3> } finish { reflection .3 } }
