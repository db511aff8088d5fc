#declare Rough = texture { pigment { rgb 1 } normal { bumps .5 } }
sphere { 0, 1 }
sphere { 0, 1 texture { Rough } }
sphere { 0, 1 pigment { granite } }
sphere { 0, 1 texture { material_map { png "picture.png" texture { } } } }
sphere { 0, 1 pigment { color_map { } } }
sphere { 0, 1 pigment { gradient x color_map { [0 rgb 1 [1 rgb 0] } } }
sphere { 0, 1 pigment { phong 1 } }
sphere { 0, 1 finish { phongg 1 } }
sphere { 0, 1 texture { phong 1 } }
sphere { 0, 1 interior { media { } } }
sphere { 0, 1 pigment { <1, 1, 1> } }
sphere { 0, 1 pigment { object { sphere { 0, 1 } } } }
