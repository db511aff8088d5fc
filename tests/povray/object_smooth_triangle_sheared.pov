// POV-Ray makes the normals unit vectors again after `scale`, not after the other transformations.
#include "stage.inc"
smooth_triangle { <0, 0, 0>, <-1, -1, -3>, <1, 0, 0>, <1, 0, -1>, <0, 1, 0>, <0, 2, -1>
  scale <1.5, .6, 3> rotate <0, 30, 20> translate <-1.5, 0, 0> pigment { rgb <.9, .2, .2> } finish { phong .6 } }
smooth_triangle { <0, 0, 0>, <-1, -1, -3>, <1, 0, 0>, <1, 0, -1>, <0, 1, 0>, <0, 2, -1>
  matrix <1, .2, 0, .5, 1.4, 0, .1, 0, 2, .3, .1, 0> pigment { rgb <.2, .8, .2> } finish { phong .6 } }
