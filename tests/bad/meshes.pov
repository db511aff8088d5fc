mesh { }
mesh { triangle { x, y, z texture_list { 1 } } }
mesh2 { vertex_vectors { 3, x, y, z } face_indices { 1, <0, 1, 3> } }
mesh2 { vertex_vectors { 3, x, y, z } normal_vectors { 2, x, y } face_indices { 1, <0, 1, 2> } }
mesh2 { vertex_vectors { 3, x, y, z } face_indices { 1, <0, 1, 2>, 0 } }
mesh2 { vertex_vectors { 3, x, y, z }
  texture_list { 2, texture { pigment { rgb 1 } } texture { pigment { rgb x } } } face_indices { 1, <0, 1, 2>, 0, 1, 0 } }
mesh2 { vertex_vectors { 3, x, y, z } uv_vectors { 1, <0, 0> } face_indices { 2, <0, 1, 2>, <0, 1, 2> } uv_indices { 1, <0, 0, 0> } }
mesh2 { vertex_vectors { 3, x, y } }
mesh2 { vertex_vectors { 3, x, y, z } face_indices { 1, <0, 1, 2> } inside_vector 0 }
difference { sphere { 0, 1 } }
intersection { light_source { 0, 1 } }
sphere { 0, 1 clipped_by { } }
sphere { 0, 1 clipped_by { bounded_by } }
