// Cones: to a point, cut off, either way up, open, scaled.
#include "stage.inc"
cone { <-1.6, -.5, 0>, .6, <-1.6, .9, 0>, 0 pigment { rgb <.9, .2, .2> } }
cone { <-.3, -.5, 0>, .2, <-.1, .6, 0>, .5 open pigment { rgb <.2, .8, .2> } }
cone { <1.2, 0, .2>, .5, <1.9, .3, -.6>, .2 pigment { rgb <.2, .3, .9> } }
cone { 0, 1, y, .4 open scale <.5, .4, .3> rotate 60*x translate <.4, 1.3, .5> pigment { rgb <.9, .8, .2> } }
cone { <.9, -.5, -1>, .3, <.9, 0, -1>, .3 pigment { rgb .8 } }
