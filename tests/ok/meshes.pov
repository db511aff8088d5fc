// mesh and mesh2 with all that they can have.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
#declare Red = texture { pigment { rgb x } }
mesh {
  triangle { 0, x, y }
  triangle { <0, 0, 1> <1, 0, 1> <0, 1, 1> texture { Red } }
  triangle { 0, x, y uv_vectors <0, 0>, <1, 0>, <0, 1> texture { Red } }
  smooth_triangle { 0, -z, x, -z, y, <1, 1, -1> uv_vectors <0, 0> <1, 0> <0, 1> }
  inside_vector y
  pigment { rgb 1 }
}
#declare Corners = array[4] { 0, x, y, <1, 1, 0> }
#declare M = mesh2 {
  vertex_vectors { 4, #for (I, 0, 3) Corners[I], #end }
  normal_vectors { 2, -z, <1, 0, -1> }
  uv_vectors { 4, <0, 0> <1, 0> <0, 1> <1, 1> }
  texture_list { 2, texture { Red } texture { pigment { rgb y } finish { phong 1 } } }
  face_indices { 3, <0, 1, 2>, 0, <1, 3, 2>, 1, 1, 1, <0, 1, 3> }
  normal_indices { 2, <0, 0, 1>, <1, 0, 0> }
  inside_vector <0, 0, 1>
  scale 2
}
object { M }
mesh2 {
  vertex_vectors { 3 <0, 0, 0> <1, 0, 0> <0, 1, 0> }
  normal_vectors { 3, -z, -z, -z }
  face_indices { 1 <0, 1, 2> }
}
