// Interpolated normals, of any length; transformations move them too.
#include "stage.inc"
#declare Shiny = finish { phong .6 phong_size 20 }
smooth_triangle { <-2, -.5, 0>, <-1, .2, -2>, <-.6, -.3, -.4>, <.5, .3, -1>, <-1.3, 1.1, .2>, <0, 1, -1>
  pigment { rgb <.9, .2, .2> } finish { Shiny } }
smooth_triangle { <0, 0, 0>, <-1, -1, -3>, <1, 0, 0>, <1, 0, -1>, <0, 1, 0>, <0, 2, -1> rotate <10, -30, 15>
  pigment { rgb <.2, .8, .2> } finish { Shiny } }
smooth_triangle { <0, 0, 0>, <-1, -1, -3>, <1, 0, 0>, <1, 0, -1>, <0, 1, 0>, <0, 2, -1> scale <1.2, .6, 2> translate <.9, .4, 0>
  pigment { rgb <.2, .3, .9> } finish { Shiny } }
