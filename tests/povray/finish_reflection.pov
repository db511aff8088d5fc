// Constant, coloured and variable reflection, falloff, exponent, metallic.
#include "stage.inc"
#macro Ball(I) sphere { <mod(I, 4)*.95 - 1.6, div(I, 4)*.95, 0>, .45 pigment { rgb <.8, .5, .3> } #end
Ball(0) finish { diffuse .3 reflection .5 } }
Ball(1) finish { diffuse .3 reflection rgb <.2, .6, .9> } }
Ball(2) finish { diffuse .3 reflection { .1, .9 } } }
Ball(3) finish { diffuse .3 reflection { .1, .9 falloff 4 } } }
Ball(4) finish { diffuse .3 reflection { .9 metallic } } }
Ball(5) finish { diffuse .3 reflection { rgb <0, .2, 0>, rgb <1, .5, 1> metallic .5 } } }
Ball(6) finish { diffuse .3 reflection { .8 exponent 2 } } }
Ball(7) finish { diffuse .3 reflection .9 reflection_exponent .7 } }
