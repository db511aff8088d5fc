// Panes that do not bend light are no levels; but no ray begins at the last one.
#include "stage.inc"
global_settings { max_trace_level 2 }
#for (I, 0, 4)
  box { <-1.2, -.4, I>, <.2 + I*.2, .6 + I*.1, I + .1> pigment { rgbt <.9, .95, 1, .9> } }
#end
sphere { <1.5, .2, -.5>, .6 pigment { rgbt <1, 1, 1, .8> } finish { reflection .4 } }
sphere { <1.5, .2, -.5>, .3 pigment { rgbt <1, .5, .5, .8> } interior { ior 1.3 } }
