// A scene so small that what rays pass over near their starts is seen: clear plates cast no shadow on a floor less than
// .001 below them, and mirrors do not see what is nearer than .0001. Cups whose parts end in one plane are closed.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
    location <0, .009, -.016>
    look_at <0, .0012, 0>
    right 4/3*x
    angle 40
}
light_source { <.03, .06, -.03> rgb 1 }
background { rgb <.3, .4, .6> }

plane {
    y, 0
    pigment { checker rgb .8, rgb .5 scale .0015 }
    finish { reflection .3 }
}

#declare Clear = texture {
    pigment { rgbf <.9, .5, .4, .8> }
    finish { diffuse .3 }
}

// Plates over the floor.
box { <-.006, .0003, -.003>, <-.002, .0006, .001> texture { Clear } }
box { <0, .00001, -.003>, <.002, .00006, .001> texture { Clear } rotate -12*z }

// Cups.
difference {
    cone { 0, .0008, .0025*y, .0016 }
    cone { .0004*y, .0005, .0025*y, .0013 }
    pigment { rgb <.2, .6, .3> }
    translate <-.0035, .0015, .005>
}
difference {
    cylinder { 0, .0025*y, .0015 open }
    cone { .0001*y, .00148, .0025*y, .00148 pigment { rgb <.8, .7, .2> } }
    pigment { rgb <.2, .3, .7> }
    translate <.0035, .0015, .005>
}
