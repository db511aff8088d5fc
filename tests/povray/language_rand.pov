// POV-Ray's random numbers, to the last digit.
#include "stage.inc"
#declare R = seed(42);
#declare Q = seed(7);
#for (I, 1, 40)
  sphere { <rand(R)*4 - 2, rand(R)*1.6 - .3, rand(R)*2 - 1>, .05 + .15*rand(Q) pigment { rgb <rand(Q), rand(Q), rand(Q)> } }
#end
