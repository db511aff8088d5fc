// povray: +FN16
// Sixteen bits a channel.
#include "stage.inc"
sphere { <-.7, .2, 0>, .7 pigment { rgb <.9, .3, .1> } finish { specular .6 } }
box { <.5, -.5, -.5>, <1.3, .7, .3> pigment { gradient y } }
