"""Measures render's errors in random worlds: floors, walls, skies and balls of all patterns, thin bodies, mirrors, glass.

    python3 tests/bench/sampling/random_worlds.py BENCH_SAMPLING FIRST LAST [WIDTH [GRID]]
    python3 tests/bench/sampling/random_worlds.py SEED > world.rt

The first writes the worlds from seed FIRST to LAST into $TMPDIR and prints their rows of the table of worlds and their
distribution; the second prints one. A seed is the same world everywhere.
"""
import math
import os
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
IMAGES = [HERE / "checks.png", HERE / "../../../scenes/pictures/parquet.png"]
SOLIDS = ("agate boxed bozo bumps cells crackle cylindrical dents gradient granite leopard marble onion planar quilted "
          "radial ripples spherical waves wood wrinkles").split()


class World:
    """Throws dice for the parts of a world."""

    def __init__(self, seed):
        self.dice = random.Random(seed)

    def between(self, low, high):
        return round(self.dice.uniform(low, high), 4)

    def size(self, low, high):
        """Returns a length: each order of magnitude is as likely as the others."""
        return float(f"{math.exp(self.dice.uniform(math.log(low), math.log(high))):.3g}")

    def chance(self, share):
        return self.dice.random() < share

    def vector(self, low, high):
        return "<" + ", ".join(f"{self.between(low, high):g}" for _ in range(3)) + ">"

    def color(self, low=0, high=1):
        return self.vector(low, high) if self.chance(.6) else self.dice.choice(["<1, 1, 1>", "<.05, .05, .05>"])

    def colors(self):
        """Returns a map of colours, in half of all cases with jumps."""
        count = self.dice.randint(2, 5)
        places = sorted([0, 1] + [self.between(0, 1) for _ in range(count - 2)])
        stops = []
        for place in places:
            stops.append(f"{place:g} {self.color()}")
            if 0 < place < 1 and self.chance(.5):
                stops.append(f"{place:g} {self.color()}")
        return "colors { " + "  ".join(stops) + " }"

    def pattern(self, scale, depth=0, skies=False):
        """Returns a pattern whose pieces are about as large as `scale`."""
        kind = self.dice.choice(["checker", "checker", "brick", "gradient", "noise", "marble", "wood", "solid", "solid"] +
                                ([] if skies else ["image"]))
        color = lambda: self.pattern(.3, depth + 1) if depth < 1 and self.chance(.1) else self.color()
        noise = lambda: (f"octaves {self.dice.randint(1, 7)}  omega {self.between(.3, .7):g}  "
                         f"lambda {self.between(1.7, 2.5):g}")
        turn = f"rotate {self.vector(0, 90)}" if self.chance(.3) else ""
        size = f"scale {scale:g}" if self.chance(.8) else f"scale <{scale:g}, {scale / 4:.4g}, {scale:g}>"
        if kind == "checker":
            words = f"{color()}, {color()}"
        elif kind == "brick":
            words = (f"{color()}, {color()}  brick_size <{self.between(.5, 1.5):g}, {self.between(.2, .6):g}, .5>  "
                     f"mortar {self.size(.01, .1):g}")
        elif kind == "gradient":
            words = f"axis {self.vector(-1, 1)}  {self.colors()}"
        elif kind == "image":
            image = os.path.relpath(self.dice.choice(IMAGES), folder())
            words = f'"{image}"' + ("  sharp" if self.chance(.3) else "")
            size = f"scale {4 * scale:g}"
        elif kind == "noise":
            words = f"{noise()}  {self.colors()}"
        elif kind == "solid":
            turbulence = f"turbulence {self.vector(0, .8)}  {noise()}" if self.chance(.5) else ""
            words = (f"{self.dice.choice(SOLIDS)}  {turbulence}  wave {self.dice.randint(0, 4)}  "
                     f"frequency {self.dice.choice([1, 1, 2, 5])}  {self.colors()}")
        else:
            words = f"turbulence {self.between(0, 1):g}  {noise()}  {self.colors()}"
        return f"{kind} {{ {words}  {size}  {turn} }}"

    def material(self, scale, flat=False):
        """Returns a material: mostly of a pattern, a mirror, or glass."""
        roll = self.dice.random()
        if roll < .2 and not flat:
            return f"material {{ rgb <1, 1, 1>  diffuse 0  specular 0  reflection {self.between(.5, 1):g} }}"
        if roll < .3 and not flat:
            return ("material { rgb <1, 1, 1>  diffuse 0  specular .5  reflection .1  refraction .9  "
                    f"ior {self.dice.choice([1, 1.1, 1.5])} }}")
        rgb = self.pattern(scale) if self.chance(.75) else self.color()
        bump = (f"bump {self.dice.choice(['noise', 'marble', 'wood'])} {{ height {self.size(.01, .1):g}  "
                f"scale {self.size(.05, 1):g} }}") if self.chance(.08) else ""
        reflection = f"{self.between(.05, .4):g}" if self.chance(.3) else "0"
        return (f"material {{ rgb {rgb}  diffuse {self.between(.5, .9):g}  ambient {self.between(0, .3):g}  "
                f"specular {self.dice.choice([0, 0, .5])}  reflection {reflection}  {bump} }}")

    def place(self, height=2.5):
        return [self.between(-3, 3), self.between(-3, 4), self.between(.1, height)]

    def thin_bodies(self):
        """Returns some bodies of one kind, .002 to .05 of a unit thin."""
        thin = self.size(.002, .05)
        kind = self.dice.choice(["disc", "ring", "triangle", "box", "cone", "mesh", "gap", "difference", "wire", "torus",
                                 "fence"])
        material = (f"material {{ rgb {self.color(.2)}  diffuse .8  ambient .2  specular 0  "
                    f"reflection {self.dice.choice([0, 0, 0, .5])} }}")
        text = lambda p: "<" + ", ".join(f"{c:.5g}" for c in p) + ">"
        bodies = []
        for _ in range(self.dice.randint(1, 4)):
            p, length = self.place(), self.size(.5, 3)
            turn = f"rotate {self.vector(-90, 90)}  translate {text(p)}"
            q = [c + length * self.between(-1, 1) for c in p]
            if kind == "disc":
                # Seen nearly edge-on where its normal is nearly across the view.
                bodies.append(f"disc {{ {text(p)}, <{self.between(-1, 1):g}, {self.between(-.2, .2):g}, 1>, "
                              f"{length / 2:.3g}  {material} }}")
            elif kind == "ring":
                bodies.append(f"disc {{ <0, 0, 0>, <0, 0, 1>, {length / 2 + thin:.5g}, {length / 2:.5g}  "
                              f"{material}  {turn} }}")
            elif kind in ("triangle", "mesh"):
                r = [a + thin * self.between(-1, 1) for a in q]
                corners = f"triangle {{ {text(p)}, {text(q)}, {text(r)}"
                bodies.append(f"mesh {{ {corners} }}  {material} }}" if kind == "mesh" else f"{corners}  {material} }}")
            elif kind == "box":
                bodies.append(f"box {{ <0, 0, 0>, <{thin:g}, {self.dice.choice([thin, length]):.3g}, {length:.3g}>  "
                              f"{material}  {turn} }}")
            elif kind == "cone":
                bodies.append(f"cone {{ {text(p)}, {thin:g}, {text(q)}, 0  {material} }}")
            elif kind == "gap":
                w = length / 2
                bodies.append(f"box {{ <{-w:.4g}, 0, 0>, <{-thin / 2:.4g}, .2, {length:.3g}>  {material}  {turn} }}")
                bodies.append(f"box {{ <{thin / 2:.4g}, 0, 0>, <{w:.4g}, .2, {length:.3g}>  {material}  {turn} }}")
            elif kind == "difference":
                bodies.append(f"difference {{ cylinder {{ <0, 0, 0>, <0, 0, {length:.3g}>, {length / 3:.4g} }}  "
                              f"cylinder {{ <0, 0, -1>, <0, 0, 4>, {length / 3 - thin:.4g} }}  {material}  {turn} }}")
            elif kind == "wire":
                bodies.append(f"cylinder {{ {text(p)}, {text(q)}, {thin / 2:g}  {material} }}")
            elif kind == "torus":
                bodies.append(f"torus {{ {text(p)}, {self.vector(-1, 1)}, {length / 2:.3g}, {thin / 2:g}  {material} }}")
            else:
                count, apart = self.dice.randint(5, 20), self.size(3 * thin, max(.3, 4 * thin))
                for i in range(count):
                    x = p[0] + i * apart
                    bodies.append(f"box {{ <{x:.4g}, {p[1]:g}, 0>, <{x + thin:.5g}, {p[1] + thin:.5g}, "
                                  f"{length:.3g}>  {material} }}")
        return bodies

    def text(self):
        height, distance, angle = self.size(.5, 8), self.size(4, 14), self.dice.choice([25, 40, 40, 60, 90])
        round_it = self.between(-60, 60) * math.pi / 180
        eye = f"<{distance * math.sin(round_it):.4g}, {-distance * math.cos(round_it):.4g}, {height:g}>"
        kind = "" if self.chance(.9) else self.dice.choice(["orthographic", "panoramic"])
        lines = [f"camera {{ position {eye}  look_at <{self.between(-1, 1):g}, 0, {self.between(0, 1.5):g}>  "
                 f"sky <0, 0, 1>  angle {angle}  {kind} }}", "global_settings { max_trace_level 7 }"]
        for _ in range(self.dice.choice([1, 1, 2])):
            soft = f"edges <{self.size(.1, 3):g}, 0, 0>, <0, {self.size(.1, 3):g}, 0>" if self.chance(.15) else ""
            lines.append(f"light {{ position <{self.between(-8, 8):g}, {self.between(-10, 2):g}, "
                         f"{self.between(4, 12):g}>  color {self.vector(.5, 1)}  {soft} }}")
        sky = self.pattern(self.size(.05, 1), skies=True) if self.chance(.4) else self.color()
        lines.append(f"background {{ color {sky} }}")
        lines.append("defaultmaterial { diffuse .8  specular 0  reflection 0 }")
        lines.append(f"plane {{ <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  {self.material(self.size(.05, 2), flat=True)} }}")
        if self.chance(.4):
            lines.append(f"box {{ <-4, 4, .001>, <{self.between(0, 4):g}, 4.2, {self.between(1, 5):g}>  "
                         f"{self.material(self.size(.03, 1))} }}")
        for _ in range(self.dice.randint(0, 3)):
            x, y, z = self.place(1.5)
            radius = self.size(.2, 1.2)
            form = self.dice.choice(["sphere", "sphere", "sphere", "box", "cylinder"])
            material = self.material(self.size(.02, .7))
            z = max(z, radius + .001)
            if form == "sphere":
                lines.append(f"sphere {{ <{x:g}, {y:g}, {z:g}>, {radius:g}  {material} }}")
            elif form == "box":
                lines.append(f"box {{ <0, 0, .001>, <{radius:g}, {radius:g}, {2 * radius:g}>  {material}  "
                             f"rotate <0, 0, {self.between(0, 90):g}>  translate <{x:g}, {y:g}, 0> }}")
            else:
                lines.append(f"cylinder {{ <{x:g}, {y:g}, .001>, <{x:g}, {y:g}, {2 * radius:g}>, {radius / 2:g}  "
                             f"{material} }}")
        if self.chance(.6):
            lines += self.thin_bodies()
        return "\n".join(lines) + "\n"


def folder():
    own = pathlib.Path(os.environ.get("TMPDIR", "/tmp")) / "random_worlds"
    own.mkdir(parents=True, exist_ok=True)
    return own


def main(args):
    if len(args) == 1:
        print(World(int(args[0])).text(), end="")
        return
    bench, first, last = args[0], int(args[1]), int(args[2])
    width, grid = (args[3:] + ["160", "17"][len(args) - 3:])[:2]
    if int(grid) < 1:
        sys.exit("GRID is at least 1: without a reference there are no errors")
    rows = []
    for seed in range(first, last + 1):
        path = folder() / f"random_{seed}.rt"
        path.write_text(World(seed).text())
        done = subprocess.run([bench, "--table", width, grid, str(path)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{path}: {done.stderr}")
        row = done.stdout.splitlines()[-1]
        print(row, flush=True)
        rows.append([float(cell) for cell in row.strip("| ").split("|")[1:]])
    print(f"{len(rows)} worlds, {width} pixels wide:  least  10 %  median  90 %  most")
    for name, column in (("samples a pixel", 0), ("RMS, 1/510", 3), ("estimate over RMS", 4), ("worst pixel", 5)):
        values = sorted(row[column] for row in rows)
        at = [values[round(share * (len(values) - 1))] for share in (0, .1, .5, .9, 1)]
        print(f"{name:20}" + "".join(f"{value:8.2f}" for value in at))
    count = lambda test: sum(map(test, rows))
    print(f"RMS above 1: {count(lambda r: r[3] > 1)}, above 2: {count(lambda r: r[3] > 2)};  "
          f"estimate below half: {count(lambda r: r[4] < .5)}, above three times: {count(lambda r: r[4] > 3)};  "
          f"worst pixel above .08: {count(lambda r: r[5] > .08)};  samples above 8: {count(lambda r: r[0] > 8)}, "
          f"above 16: {count(lambda r: r[0] > 16)}")


main(sys.argv[1:])
