// Refraction and total reflection: a glass ball, a prism of a box, glass in glass.
#include "stage.inc"
#declare Clear = texture { pigment { rgbf <.97, .98, .97, .95> } finish { ambient 0 diffuse .05 phong .5 reflection .05 } }
sphere { <-1.3, .3, -.3>, .7 texture { Clear } interior { ior 1.5 } }
box { <-.5, -.45, -.4>, <.4, .9, .3> rotate 35*y texture { Clear } interior { ior 1.4 } }
sphere { <1.5, .3, -.2>, .7 texture { Clear } interior { ior 1.33 } }
sphere { <1.5, .3, -.2>, .35 texture { Clear } interior { ior 1.8 } }
