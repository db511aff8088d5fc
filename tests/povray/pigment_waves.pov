// The wave forms, with frequency and phase.
#include "stage.inc"
#macro Bar(I) box { <-2, I*.3 - .5, -.2>, <2, I*.3 - .25, .2>
  pigment { gradient x frequency .7 phase I*.1 color_map { [0 rgb 0] [1 rgb <1, .9, .7>] } #end
Bar(0) ramp_wave } }
Bar(1) triangle_wave } }
Bar(2) sine_wave } }
Bar(3) scallop_wave } }
Bar(4) cubic_wave } }
Bar(5) poly_wave 2.5 } }
Bar(6) poly_wave } }
