// Shadows of what filters and what transmits, through several surfaces and layers.
#include "stage.inc"
sphere { <-1.3, .6, 0>, .6 pigment { rgbf <.9, .3, .2, .9> } }
box { <-.2, .4, -.6>, <.8, .6, .4> pigment { rgbt <.2, .9, .3, .6> } }
disc { <.3, 1.2, 0>, y, .4 pigment { checker rgbf <1, 1, .2, 1>, rgb .3 scale .2 } }
sphere { <1.8, .3, .2>, .5 texture { pigment { rgbf <1, .6, .6, 1> } } texture { pigment { rgbft <.3, .6, 1, .5, .3> } finish { phong 1 } } }
