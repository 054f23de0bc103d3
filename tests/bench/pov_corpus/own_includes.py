"""Writes a scene for each texture, pigment, normal, finish, interior, material, sky and body that POV-Ray's own include
files declare, for tests/bench/pov_corpus/run:

    python3 tests/bench/pov_corpus/own_includes.py FOLDER [INCLUDES]    # /usr/share/povray-3.7/include
"""
import pathlib
import re
import sys

FILES = ("textures stones1 stones2 stoneold woods metals golds glass glass_old skies finish stars shapes shapes2 shapesq "
         "shapes_old").split()
HEAD = """#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level 6 }}
#include "colors.inc"
#include "{file}.inc"
camera {{ location <0,1.2,-4> look_at <0,.6,0> angle 42 }}
light_source {{ <5,8,-6> rgb 1 }}
plane {{ y, {floor} pigment {{ checker rgb .8, rgb .4 }} }}
"""
LOOKS = {
    "texture": "texture {{ {0} }}",
    "material": "material {{ {0} }}",
    "pigment": "pigment {{ {0} }}",
    "normal": "pigment {{ rgb .7 }} normal {{ {0} }}",
    "finish": "pigment {{ rgb <.8,.5,.3> }} finish {{ {0} }}",
    "interior": "pigment {{ rgbt <.9,.9,1,.8> }} interior {{ {0} }}",
    "sky_sphere": "pigment {{ rgb .5 }} finish {{ reflection .6 }}",
}
BODIES = ("object union intersection difference merge box cylinder cone sphere quadric quartic torus superellipsoid poly "
          "cubic plane height_field").split()


def scene_of(file, name, sort):
    """Returns the text of a scene, or nothing for a declaration that can't be shown."""
    if sort in BODIES:
        return HEAD.format(file=file, floor=-1.5) + (
            f"object {{ {name} pigment {{ rgb <.9,.6,.3> }} finish {{ phong .5 }} rotate <15,30,0> scale .6 "
            "translate .6*y }\n")
    if sort not in LOOKS:
        return None
    look = LOOKS[sort].format(name)
    sky = f"sky_sphere {{ {name} }}\n" if sort == "sky_sphere" else ""
    return HEAD.format(file=file, floor=0) + sky + (
        f"sphere {{ <-.8,.7,0>, .7 {look} }}\nbox {{ <.2,0,-.4>, <1.4,1.1,.5> {look} }}\n")


def main():
    folder = pathlib.Path(sys.argv[1])
    includes = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "/usr/share/povray-3.7/include")
    folder.mkdir(parents=True, exist_ok=True)
    for file in FILES:
        text = (includes / f"{file}.inc").read_text(errors="replace")
        text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
        sorts = {}
        for name, sort in re.findall(r"#(?:declare|local)\s+(\w+)\s*=\s*(\w+)", text):
            # What is declared as another thing is of the same sort.
            sorts.setdefault(name, sorts.get(sort, sort))
        for name, sort in sorts.items():
            scene = scene_of(file, name, sort)
            if scene:
                (folder / f"{file}_{name}.pov").write_text(scene)


main()
