// specular and roughness, albedo, metallic.
#include "stage.inc"
#macro Ball(I) sphere { <mod(I, 4)*.95 - 1.6, div(I, 4)*.95, 0>, .45 pigment { rgb <.3, .5, .8> } #end
Ball(0) finish { specular .8 } }
Ball(1) finish { specular .8 roughness .2 } }
Ball(2) finish { specular 1 roughness .001 } }
Ball(3) finish { specular 1 metallic } }
Ball(4) finish { specular albedo .3 roughness .1 } }
Ball(5) finish { specular .9 roughness .02 metallic 2 } }
Ball(6) finish { specular .6 brilliance 2 } }
Ball(7) finish { specular 2 roughness 1 } }
