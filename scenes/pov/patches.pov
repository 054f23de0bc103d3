// Bicubic patches: divided by their steps and by how flat they are, moved, scaled unevenly, and with places by uv.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <1, 6, -11> right x*4/3 look_at <.2, .4, 0> angle 44 }
light_source { <-10, 20, -15>, rgb .9 }
light_source { <10, 8, -15>, rgb .3 }
background { rgb <.4, .5, .7> }
plane { y, -1.5 pigment { checker rgb .8, rgb .5 } }

// A sheet in the wind; S is how strong it blows.
#macro Sheet(S)
  <-1.5, S, -1.5>, <-.5, -S, -1.6>, <.5, .3 * S, -1.3>, <1.5, -.2 * S, -1.5>
  <-1.6, -S, -.5>, <-.4, 2 * S, -.5>, <.6, 1.5 * S, -.4>, <1.4, S, -.5>
  <-1.4, .5 * S, .5>, <-.6, 1.8 * S, .4>, <.4, -2 * S, .5>, <1.6, -S, .6>
  <-1.5, 0, 1.5>, <-.5, S, 1.6>, <.5, -S, 1.4>, <1.5, S, 1.5>
#end
bicubic_patch {
  type 1 flatness 0 u_steps 4 v_steps 4 Sheet(1)
  pigment { rgb <.8, .3, .2> } finish { phong .6 } rotate <-40, 20, 0> translate <-3, 1.4, 2>
}
bicubic_patch {
  type 1 flatness .1 u_steps 5 v_steps 5 Sheet(1)
  pigment { rgb <.3, .4, .8> } finish { phong .6 } rotate <-40, 20, 0> translate <.5, 1.4, 2>
}
// The same flatness divides what is small less often.
bicubic_patch {
  type 1 flatness .1 u_steps 5 v_steps 5 Sheet(1)
  pigment { rgb <.2, .6, .3> } finish { phong .6 } rotate <-40, 20, 0> scale .3 translate <2, 0, -4>
}
bicubic_patch {
  type 1 flatness 0 u_steps 3 v_steps 1 Sheet(.7)
  pigment { rgb <.8, .7, .2> } finish { specular .5 } scale <1, .6, 1.4> rotate -30*x translate <3.6, 1, 1>
}
union {
  bicubic_patch {
    type 1 flatness .02 u_steps 4 v_steps 4 Sheet(.5)
    pigment { rgb <.7, .5, .8> } rotate 50*y
  }
  bicubic_patch {
    1 2 2 Sheet(.5)
    pigment { rgb <.5, .8, .8> } finish { reflection .3 } rotate 50*z translate 2*x
  }
  scale <.8, 1.6, .5> rotate -20*x translate <-3.4, -.4, -1>
}
bicubic_patch {
  type 1 flatness 0 u_steps 4 v_steps 4 uv_vectors <0, 0>, <2, 0>, <2, 1>, <0, 1> Sheet(.8)
  uv_mapping pigment { checker rgb <.9, .5, .3>, rgb .2 scale .2 } rotate <-20, 0, 10> scale .9 translate <.4, -.5, -2.5>
}
