// no_shadow, no_image, no_reflection, double_illuminate, hollow.
#include "stage.inc"
sphere { <-1.5, .3, 0>, .5 no_shadow pigment { rgb <.9, .2, .2> } }
sphere { <0, .3, 0>, .5 no_image pigment { rgb <.2, .8, .2> } }
sphere { <1.4, .3, -.5>, .5 no_reflection pigment { rgb <.2, .3, .9> } }
plane { -z, -2 pigment { rgb .1 } finish { reflection .8 } hollow }
disc { <.4, 1.6, -1>, <0, -1, -.3>, .6 double_illuminate pigment { rgb <.9, .8, .2> } }
