// Mirrors facing each other: max_trace_level and adc_bailout end it.
#include "stage.inc"
global_settings { max_trace_level 7 adc_bailout .02 }
box { <-2.5, -.5, 1.5>, <2.5, 2, 1.6> pigment { rgb .1 } finish { reflection .8 } }
box { <-2.5, -.5, -9>, <2.5, 3, -8.9> pigment { rgb .1 } finish { reflection <.9, .6, .5> } }
sphere { <-.6, .1, 0>, .5 pigment { rgb <.9, .2, .2> } finish { reflection .3 } }
box { <.3, -.5, -.4>, <1.1, .3, .4> rotate 10*y pigment { rgb <.2, .4, .8> } finish { reflection { .5 metallic } } }
