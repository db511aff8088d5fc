sphere { 0, 1 texture { gradient x } }
sphere { 0, 1 texture { gradient x texture_map { } } }
sphere { 0, 1 texture { gradient x texture_map { [0 rgb 1] } } }
sphere { 0, 1 texture { gradient x color_map { [0 rgb 1] } } }
sphere { 0, 1 texture { checker texture { pigment { rgb 1 } } pigment { rgb 0 } } }
#declare Mapped = texture { checker texture { pigment { rgb 1 } } texture { pigment { rgb 0 } } }
sphere { 0, 1 texture { Mapped pigment { rgb 1 } } }
sphere { 0, 1 texture { Mapped } texture { pigment { rgbt 1 } } }
sphere { 0, 1 texture { pigment { rgb 1 } } texture { Mapped } }
sphere { 0, 1 texture { Mapped } finish { phong 1 } }
#default { texture { Mapped } }
sphere { 0, 1 material { texture { pigment { rgb 1 } } phong 1 } }
sphere { 0, 1 material { Mapped } }
#declare Rough = material { texture { pigment { rgb 1 } normal { bumps 1 } } }
sphere { 0, 1 material { Rough } }
