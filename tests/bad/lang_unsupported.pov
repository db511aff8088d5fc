// What is declared with something unsupported is an error where it is used, and only there.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Stone = texture { pigment { granite scale 2 } } texture { pigment { marble } }
#declare Bumps = normal { bumps .5 }
#declare Fn = function(x, y, z) { x*y*z }
#declare Value = Fn(1, 2, 3) + 1;
#declare Fog = fog { fog_type 2 turbulence 1 }
#declare Letter = text { ttf "timrom.ttf" "A" 1, 0 }
sphere { 0, 1 texture { Stone } }
sphere { 0, 1 normal { Bumps } }
sphere { 0, Value }
sphere { 0, Fn(1, 2, 3) }
fog { Fog }
object { Letter }
