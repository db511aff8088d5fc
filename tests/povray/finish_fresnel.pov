// Fresnel reflection, with one colour and two; conserve_energy.
#include "stage.inc"
#macro Ball(I) sphere { <I*1.05 - 1.6, .1, 0>, .5 interior { ior 1.6 } #end
#default { finish { diffuse .3 ambient 0 } }
Ball(0) pigment { rgb <.8, .3, .2> } finish { reflection { 1 fresnel } } }
Ball(1) pigment { rgb <.2, .3, .8> } finish { reflection { .2, 1 fresnel on } } }
Ball(2) pigment { rgbf <.9, .9, .8, .9> } finish { reflection { 0, 1 fresnel } conserve_energy } }
Ball(3) pigment { rgbt <.9, .5, .4, .7> } finish { reflection { .1, .9 } conserve_energy } }
