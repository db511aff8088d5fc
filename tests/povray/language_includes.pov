// POV-Ray's own include files.
#include "colors.inc"
#include "math.inc"
#include "transforms.inc"
#include "shapes.inc"
#include "metals.inc"
#include "glass.inc"
#include "golds.inc"
#include "finish.inc"
#include "stage.inc"
sphere { <-1.6, .1, 0>, .5 texture { T_Gold_3C } }
sphere { <-.5, .1, 0>, .5 texture { T_Chrome_2B } }
sphere { <.6, .1, 0>, .5 texture { T_Glass3 } interior { I_Glass1 } }
box { -.4, .4 Reorient_Trans(x, <1, 1, 1>) translate <1.6, .2, 0> pigment { MediumSeaGreen } finish { Shiny } }
sphere { <0, 1.2, 0>, .4 pigment { CornflowerBlue } finish { Glossy } Shear_Trans(x, y + .3*x, z) }
