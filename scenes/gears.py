"""Writes gears.rt: a field of toothed wheels on a square lattice, all of which mesh with their neighbours.

    python3 scenes/gears.py
"""
import math
import pathlib

SIDE, TEETH = 17, 60  # wheels along each side; teeth, a multiple of 4 so that neighbours on all four sides mesh
METALS = ["brass", "copper", "brass", "steel"]

HEAD = """/* A machine of 289 wheels with 70 parts each, 20,230 bodies in all. Each wheel meshes with its four
   neighbours, which would turn the other way; waves run through the field and lift the wheels. gears.py writes this
   file. */

camera { position <-3,-19.8,4.4>  look_at <.8,-6,1.3>  sky <0,0,1>  angle 52  aspectratio 1.333333 }
global_settings { ambient_light <.5,.5,.6>  max_trace_level 5 }
background { color gradient { axis <0,0,1>
                              colors { 0 <1,.72,.46>  .12 <.86,.48,.46>  .4 <.36,.26,.48>  1 <.08,.10,.28> } } }

light { position <-30,-2,22>  color <1.15,.90,.64> }
light { position <20,-30,30>  color <.38,.42,.56> }

define brass material { rgb <.92,.66,.24>  reflection .25  diffuse .6  ambient .2  specular .9  pow 70 }
define copper material { rgb <.86,.38,.20>  reflection .22  diffuse .6  ambient .2  specular .8  pow 60 }
define steel material { rgb <.66,.70,.76>  reflection .35  diffuse .5  ambient .2  specular 1  pow 90 }
define dark material { rgb <.16,.20,.30>  reflection .3  diffuse .55  ambient .2  specular 1  pow 90 }
define ruby material { rgb <.80,.04,.10>  reflection .2  diffuse .6  ambient .3  specular 1  pow 150 }

plane { <0,0,-2>, <1,0,-2>, <0,1,-2>  material dark { rgb <.30,.16,.14>  reflection .45 } }
"""


def wheel():
    """Returns a wheel of radius 1 around the z axis: teeth, rim, disc, axle, and six rivets."""
    parts = [f"box {{ <.86,-.024,0>, <1.03,.024,.2>  rotate <0,0,{360 * n / TEETH:g}> }}" for n in range(TEETH)]
    parts += ["cylinder { <0,0,0>, <0,0,.2>, .88 }", "torus { <0,0,.2>, <0,0,1>, .76, .06 }",
              "cylinder { <0,0,-3>, <0,0,.42>, .2  material steel }",
              "sphere { <0,0,.42>, .17  material ruby }"]
    parts += [f"sphere {{ <.48,0,.2>, .09  material steel  rotate <0,0,{60 * n}> }}" for n in range(6)]
    return "define wheel union {\n" + "".join(f"  {part}\n" for part in parts) + "}\n"


def field():
    """Returns the wheels. In every second place of the lattice they are turned by half a tooth."""
    lines = []
    for i in range(SIDE):
        for j in range(SIDE):
            x, y = 1.93 * (i - SIDE // 2), 1.93 * (j - SIDE // 2)
            height = .8 * math.sin(.36 * x + .25 * y) + .5 * math.sin(.5 * y - .22 * x)
            turn = (i + j) % 2 * 180 / TEETH
            metal = METALS[(3 * i + 5 * j + i * j) % 4]
            place = f"rotate <0,0,{turn:g}>  translate <{x:.2f},{y:.2f},{height:.3f}>"
            lines.append(f"wheel {{ material {metal}  {place} }}\n")
    return "".join(lines)


path = pathlib.Path(__file__).resolve().with_name("gears.rt")
path.write_text(HEAD + "\n" + wheel() + "\n" + field())
