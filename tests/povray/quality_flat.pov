// povray: +Q1
// The lowest quality: pigments without light.
#include "stage.inc"
sphere { <-.7, .2, 0>, .7 pigment { checker rgb <.9, .3, .1>, rgb .2 scale .2 } finish { reflection .3 phong .8 } }
box { <.5, -.5, -.5>, <1.3, .7, .3> pigment { gradient y } }
