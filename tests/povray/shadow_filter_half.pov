// Whole objects of `filter .5` and `transmit .3`, behind one another.
#include "stage.inc"
box { <-1.8, -.5, 0>, <-.4, 1, .2> pigment { rgb <.9, .5, .2> filter .5 } }
box { <-1.2, -.3, -1>, <.4, .7, -.8> pigment { color rgb <.2, .5, .9> transmit .3 } }
sphere { <1.3, .2, -.2>, .7 pigment { rgb <.5, .9, .5> filter .5 transmit .3 } }
