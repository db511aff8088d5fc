// A comment without its end.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, -x }
sphere { 0, 1 } /* outer /* inner */
sphere { 0, 1 }
