// fade_distance and fade_power.
#declare No_light = 1;
#include "stage.inc"
light_source { <-2, 2, -1> rgb 1 fade_distance 1.5 fade_power 2 }
light_source { <2.5, 1, -1> rgb <.3, .6, 1> fade_distance 2 fade_power 1 }
light_source { <0, 4, 5> rgb .2 fade_distance 3 fade_power 0 }
sphere { <-.7, .1, 0>, .6 pigment { rgb .9 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> pigment { rgb .8 } }
