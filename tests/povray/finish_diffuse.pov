// ambient, emission, diffuse, brilliance, albedo.
#include "stage.inc"
global_settings { ambient_light rgb <1, .8, .6> }
#macro Ball(I) sphere { <mod(I, 4)*.95 - 1.6, div(I, 4)*.95, 0>, .45 pigment { rgb <.8, .6, .4> } #end
Ball(0) finish { ambient .5 diffuse .3 } }
Ball(1) finish { ambient rgb <0, .2, .6> } }
Ball(2) finish { emission rgb <.3, 0, .1> } }
Ball(3) finish { diffuse 1 ambient 0 } }
Ball(4) finish { brilliance 3 } }
Ball(5) finish { brilliance .4 } }
Ball(6) finish { diffuse albedo .6 brilliance 4 } }
Ball(7) finish { ambient 0 diffuse albedo .8 } }
