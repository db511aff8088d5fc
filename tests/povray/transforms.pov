// translate, rotate, scale, matrix, transform blocks, inverse, declared and nested.
#include "stage.inc"
#declare T = transform { rotate <20, 30, 10> scale <.8, 1.2, .6> translate <.2, .1, 0> }
#declare U = transform { T rotate 45*y }
#declare B = box { -.4, .4 pigment { checker rgb <.9, .7, .4>, rgb .2 scale .2 } }
object { B transform T translate <-1.6, .1, 0> }
object { B transform { U } translate <-.4, .3, 0> }
object { B transform { T inverse } scale .7 translate <.9, .2, 0> }
object { B matrix <.8, .2, 0, -.2, .9, .1, .3, 0, .7, 1.9, .4, .3> }
object { B scale <-1, .5, 1> rotate z*30 translate <.3, 1.4, .5> }
