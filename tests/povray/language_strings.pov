// Strings become numbers: str, concat, strlen, val, asc, substr, strcmp.
#include "stage.inc"
#declare S = concat("abc", str(12.345, 6, 2), "xyz");
#declare N = val(substr(S, 4, 6));
#for (I, 1, strlen(S))
  box { <I*.25 - 2, -.5, 0>, <I*.25 - 1.8, asc(substr(S, I, 1))/100 - .3, .2> pigment { rgb <N/20, I/12, (strcmp(S, "b") < 0)> } }
#end
