// Layers and textures in patterns that have bumps of their own: each is lit, mirrors and refracts by its own normals.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }

camera { location <0, 4, -8> look_at <0, .6, 0> angle 50 }
light_source { <-6, 10, -9>, rgb .9 }
light_source { <5, 4, -3>, rgb <.3, .3, .5> }
plane { y, -.2 pigment { checker rgb .7, rgb .5 } }

#declare Bumpy = texture { pigment { rgb <.9, .6, .3> } normal { bumps .6 scale .1 } finish { phong .7 reflection .15 } }
#declare Wavy = texture { pigment { rgb <.3, .5, .9> } normal { waves .5 scale .15 } finish { specular .5 reflection .3 } }
#declare Flat = texture { pigment { rgb <.2, .8, .4> } finish { phong 1 reflection .2 } }
#declare Veil = texture { pigment { rgbt <1, 0, 0, .6> } normal { wrinkles .8 scale .3 } finish { phong .8 } }
#declare Clear = texture {
  pigment { rgbf <.9, 1, .9, .8> } normal { ripples .4 scale .2 } finish { phong .9 diffuse .2 }
}
sphere { <-3, .8, 0>, .8 texture { checker texture { Bumpy } texture { Wavy } scale .4 } }
sphere { <-1, .8, 0>, .8 texture { bozo texture_map { [.3 Bumpy] [.6 Flat] [.8 Wavy] } scale .3 } }
sphere { <1, .8, 0>, .8 texture { Wavy } texture { Veil } }
sphere { <3, .8, 0>, .8 texture { Flat } texture { Veil } }
box {
  <-3.5, 0, -2.6>, <-2.4, .9, -1.6>
  texture { brick texture { Flat } texture { Bumpy } brick_size <.5, .2, .3> mortar .05 }
}
sphere { <-.9, .5, -2>, .6 texture { Veil } texture { pigment { rgbt <0, 0, .6, .7> } finish { phong 1 } } interior { ior 1.2 } }
sphere { <.8, .5, -2>, .6 texture { checker texture { Clear } texture { Bumpy } scale .3 } interior { ior 1.1 } }
cylinder { <2.4, 0, -2>, <2.4, 1, -2>, .5 open texture { Bumpy } interior_texture { Wavy } }
