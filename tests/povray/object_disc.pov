// Discs, with a hole, tilted, scaled to an ellipse; both sides.
#include "stage.inc"
disc { <-1.4, .3, 0>, <.3, .2, -1>, .8 pigment { rgb <.9, .2, .2> } }
disc { <.1, .4, 0>, <0, 1, -.6>, .7, .35 pigment { rgb <.2, .8, .2> } }
disc { 0, z, 1 scale <.8, .3, 1> rotate <20, 30, 40> translate <1.5, .5, 0> pigment { rgb <.2, .3, .9> } }
disc { <.2, 1.5, 1>, <0, -1, -.4>, .6 pigment { rgb <.9, .8, .2> } }
