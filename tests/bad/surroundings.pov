camera { angle 180 }
camera { angle -1 }
camera { location x look_at x }
camera { location 5*y look_at 0 }
camera { right x direction x + z }
camera { location x perspective }
camera { fisheye }
global_settings { assumed_gamma 0 max_trace_level 0 radiosity { count 3 } charset utf8 }
fog { fog_type 3 }
sky_sphere { pigment { rgb 1 } }
sky_sphere { pigment { rgb 1 } }
light_source { 0, 1 looks_like { pigment { rgb 1 } } }
sphere { 0, 1 }
camera { spherical }
fog { up 0 fog_type 2 }
