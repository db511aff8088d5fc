// Macros: wrong arguments, and errors inside of a body, which are told with the place of the call.
#version 3.7;
global_settings { assumed_gamma 1 }
#macro Ball(Where, Size)
  sphere { Where, Size pigment { colour Tint } }
#end
#macro Twice(X)
  Ball(X, 1)
  Ball(X, "two")
#end
Ball(0)
Ball(0, 1, 2)
Ball(, 1)
Ball(Undeclared, 1)
Twice(<1, 2, 3>)
#macro Endless(N) Endless(N + 1) #end
Endless(0)
sphere { 0, 1 pigment { color rgb Oops } }
#macro Open(X)
  sphere { X, 1
