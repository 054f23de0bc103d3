// What rays pass over near clear surfaces: shadows do so behind each of them again, and all rays pass over what a blob
// has within .01 of their starts. A light on a surface shines to both sides of it.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
    location <0, .07, -.15>
    look_at <0, .012, 0>
    right 4/3*x
    angle 40
}
light_source { <.04, .09, -.05> rgb .6 }
light_source { <0, .06, .01> rgb <.2, .4, .2> }  // on the lower side of the box
background { rgb <.3, .4, .6> }

plane { y, 0 pigment { checker rgb .8, rgb .5 scale .015 } }
box { <-.01, .06, 0>, <.01, .065, .02> pigment { rgb <.8, .3, .3> } }

// Leaves that are nearer to each other than .001.
#declare Leaf = texture { pigment { rgbf <.9, .95, .8, .7> } finish { diffuse .3 } }
union {
    #for (I, 0, 7)
        box { <-.012, .0007*I, -.01>, <.012, .0007*I + .0003, .01> texture { Leaf } }
    #end
    rotate 20*y
    translate <-.035, .008, -.005>
}
// Panes that let no light through together, but where they cross.
box { <-.02, .02, -.02>, <.015, .0203, .012> pigment { rgbf <1, 0, 0, 1> } finish { diffuse 0 } rotate 2*z translate -.02*z }
box { <-.02, .02, -.02>, <.015, .0203, .012> pigment { rgbf <0, 1, 0, 1> } finish { diffuse 0 } rotate -1*z translate -.02*z }
union {
    sphere { .012*y, .007 }
    cone { 0, .009, .028*y, 0 }
    texture { Leaf }
    translate <0, .003, -.02>
}

// A blob, parts of which are thinner than .01.
blob {
    threshold .5
    sphere { <-.012, .014, 0>, .018, 1 }
    sphere { <.012, .014, 0>, .018, 1 }
    cylinder { <-.02, .026, .004>, <.022, .026, -.004>, .009, .9 }
    pigment { rgbf <.8, .9, 1, .8> }
    finish { diffuse .2 reflection .15 phong .5 }
    translate .035*x
}
