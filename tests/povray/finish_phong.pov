// phong and its size, albedo, metallic.
#include "stage.inc"
#macro Ball(I) sphere { <mod(I, 4)*.95 - 1.6, div(I, 4)*.95, 0>, .45 pigment { rgb <.7, .4, .2> } #end
Ball(0) finish { phong .8 } }
Ball(1) finish { phong .8 phong_size 5 } }
Ball(2) finish { phong 1 phong_size 180 } }
Ball(3) finish { phong 1 metallic } }
Ball(4) finish { phong albedo .3 phong_size 8 } }
Ball(5) finish { phong .9 phong_size 8 metallic .5 } }
Ball(6) finish { phong 3 phong_size 1 } }
Ball(7) finish { phong .4 specular .5 } }
