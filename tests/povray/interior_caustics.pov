// caustics: brighter shadows where light passes straight.
#include "stage.inc"
sphere { <-1, .3, 0>, .6 pigment { rgbf <1, .9, .9, .9> } interior { ior 1.5 caustics .7 } }
sphere { <.8, .3, 0>, .6 pigment { rgbf <.7, .9, 1, .9> } interior { ior 1.3 caustics 2 } finish { phong .8 } }
