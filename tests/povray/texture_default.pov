// #default for pigments, finishes and textures; an object without a texture has the default of its place in the file.
#include "stage.inc"
sphere { <-1.8, 0, 0>, .5 }
#default { pigment { rgb <.2, .7, .3> } }
sphere { <-.6, 0, 0>, .5 }
#default { finish { ambient .3 phong .9 } }
sphere { <.6, 0, 0>, .5 }
#default { texture { pigment { checker rgb 1, rgb <.8, .2, .2> scale .2 } finish { ambient 0 diffuse .9 } } }
sphere { <1.8, 0, 0>, .5 }
sphere { <0, 1.2, 0>, .5 finish { phong 1 } }
