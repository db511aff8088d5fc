// #while, #for with steps and #break, #if, #switch with ranges.
#include "stage.inc"
#declare I = 0;
#while (I < 12)
  sphere { <cos(I*pi/6)*1.6, sin(I*pi/3)*.3 + .4, sin(I*pi/6)*1.6>, .25
    #switch (I)
      #case (0) pigment { rgb x } #break
      #case (1)
      #case (2) pigment { rgb y } #break
      #range (5, 7) pigment { rgb z } #break
      #else pigment { rgb <I/12, 1 - I/12, .5> }
    #end
  }
  #declare I = I + 1;
#end
#for (J, 2, -2, -.5)
  #if (J = 0) #break #end
  #if (J > 1.4) box { J - .1, J + .1 } #elseif (J < 1) sphere { <J, .8, J>, .2 pigment { rgb <.9, .3, .9> } } #else cylinder { <J, -.5, -1>, <J, J/2, -1>, .1 pigment { rgb <.9, .8, .1> } } #end
#end
