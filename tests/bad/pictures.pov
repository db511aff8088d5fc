sphere { 0, 1 pigment { image_map { png "no_such_picture.png" } } }
sphere { 0, 1 pigment { image_map { png "bad/pictures.pov" } } }
sphere { 0, 1 pigment { image_map { jpeg "picture.jpg" } } }
sphere { 0, 1 pigment { image_map { "picture.jpg" } } }
sphere { 0, 1 pigment { image_map { png } } }
sphere { 0, 1 pigment { image_map { png "povray/picture.png" map_type 3 } } }
sphere { 0, 1 pigment { image_map { png "povray/picture.png" interpolate 4 } } }
sphere { 0, 1 pigment { image_map { png "povray/picture.png" filter 0, .5 } } }
sphere { 0, 1 pigment { image_map { png "povray/picture.png" twice } } }
sphere { 0, 1 pigment { image_map { function 10, 10 { x } } } }
