// povray: +Q3
// A low quality: no shadows, no reflection, no transparency.
#include "stage.inc"
sphere { <-.7, .2, 0>, .7 pigment { rgbf <.9, .3, .1, .5> } finish { reflection .3 phong .8 } }
box { <.5, -.5, -.5>, <1.3, .7, .3> pigment { gradient y } }
