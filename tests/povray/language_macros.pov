// Macros: arguments by reference, locals, results as text, recursion, a macro that returns a value.
#include "stage.inc"
#macro Grow(X) #declare X = X*1.3; #end
#macro Sum(A, B) A + B #end
#macro Tree(N, S)
  union {
    cylinder { 0, y, .12 pigment { rgb <.5, .3, .2> } }
    #if (N > 0)
      object { Tree(N - 1, S) scale S rotate 35*z translate y }
      object { Tree(N - 1, S) scale S rotate <20, 120, -30> translate y }
    #else sphere { y, .3 pigment { rgb <.2, .7, .2> } } #end
  }
#end
#local R = .2;
#for (I, 0, 3) sphere { <I*.9 - 2, -.2, -1>, R pigment { rgb <.9, .2*I, .1> } } Grow(R) #end
object { Tree(4, .75) translate <1, -.5, .5> scale .8 }
box { <-1.6, -.5, 1>, <-1.2, Sum(.4, .6)*1.5, 1.4> pigment { rgb <.3, .4, .9> } }
