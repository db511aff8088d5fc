// Brackets that do not match: the statements after them are read all the same.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 } }
sphere { 0, 1 };
sphere { 0, }
union {
  sphere { 0, 1 }
  sphere { 0, 1, 2 }
  box { 0, 1 }
}
plane { y, <1, 2 }
cylinder { <0, 0, 0, y, 1 }
sphere { (0, 1 }
box { 0, 1
sphere { 0, x }
sphere { 0, 1 texture { pigment { color rgb 1 } }
camera { location <0, 0, -5> look_at 0 }
