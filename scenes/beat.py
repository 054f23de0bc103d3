"""Composes the music of beat.rt and the tracks that the scene follows. Writes beat.wav and beat.tracks beside itself.

    python3 scenes/beat.py
    oggenc -q 0 -o scenes/beat.ogg scenes/beat.wav && rm scenes/beat.wav

Notes that ring beyond the last bar sound at the beginning, so that the eight bars repeat without a seam.
"""
import array
import math
import pathlib
import random
import textwrap
import wave

RATE, BPM, BARS = 44100, 125, 8
STEP = RATE * 60 // BPM // 4  # samples of a sixteenth note: a whole number
LENGTH = 16 * BARS * STEP
ROWS = 2 * 16 * BARS  # the scene has 8 rows in a beat: two in a sixteenth
FOLDER = pathlib.Path(__file__).resolve().parent

# The score, by bars: chords as MIDI numbers, the bass first; the rest by sixteenths, of which '.' is silent.
CHORDS = [[33, 57, 60, 64, 67, 71], [29, 53, 57, 60, 64, 67], [36, 55, 60, 62, 64, 67], [31, 55, 59, 62, 64, 69],
          [33, 57, 60, 64, 67, 71], [29, 57, 60, 64, 65, 72], [26, 57, 60, 62, 65, 69], [33, 57, 60, 64, 71, 76]]
NOTES = {"A": 69, "C": 72, "D": 74, "E": 76, "G": 79, "a": 81}
MELODY = ["E..D..C.A..C..D.", "C..A..G.A..C....", "E..G..E.D..C..D.", "D...E.D.G..A..C.",
          "a..G..E.D..E..G.", "a..G..E.C..D..E.", "D..E..G.a..G..E.", "E..D..C.A......."]
BASS = ["x.x.x.x.x.x.x.x."] * 7 + ["x..............."]
DRUM = ["x...x...x...x..."] * 7 + ["x..............."]
CLAP = ["................"] * 2 + ["....x.......x..."] * 5 + ["....x..........."]
HAT = ["................"] * 2 + ["..x...x...x...x."] * 2 + ["x.xxx.xxx.xxx.xx"] * 3 + ["..............x."]


def hits(part):
    """Returns (sixteenth, character) for each note of a part."""
    return [(i, c) for i, c in enumerate("".join(part)) if c != "."]


# The sound.
left, right = array.array("d", bytes(8 * LENGTH)), array.array("d", bytes(8 * LENGTH))


def mix(step, samples, volume, pan=0.0):
    """Adds samples from a sixteenth on. pan: -1 left, 1 right, of equal power everywhere."""
    to_left, to_right = (volume * f((pan + 1) * math.pi / 4) for f in (math.cos, math.sin))
    for i, sample in enumerate(samples, round(step * STEP)):
        left[i % LENGTH] += to_left * sample
        right[i % LENGTH] += to_right * sample


def tone(note, overtones, seconds, decay, attack=.004):
    """Returns a note of overtones of the given strengths, which decays by 1/e in `decay` seconds."""
    period = [sum(a * math.sin(2 * math.pi * (n + 1) * i / 2048) for n, a in enumerate(overtones)) for i in range(2048)]
    pace = 440 * 2 ** ((note - 69) / 12) * 2048 / RATE
    times = [i / RATE for i in range(int(seconds * RATE))]
    return [period[int(i * pace) & 2047] * math.exp(-t / decay) * min(1, t / attack, (seconds - t) / .05)
            for i, t in enumerate(times)]


def noise(seconds, decay, sharpness):
    """Returns decaying noise. Each difference of neighbours takes low frequencies away."""
    source = random.Random(1)
    values = [source.uniform(-1, 1) for _ in range(int(seconds * RATE))]
    for _ in range(sharpness):
        values = [b - a for a, b in zip(values, values[1:])]
    return [v * math.exp(-i / RATE / decay) for i, v in enumerate(values)]


def compose():
    warm, bright = [1, .5, .33, .22, .14, .08], [1, .3, .5, .2, .3, .1, .15, .05]
    for bar, (_, *chord) in enumerate(CHORDS):
        for n, note in enumerate(chord):
            for side in (-.06, .06):  # out of tune with each other, which makes chords wide
                mix(16 * bar, tone(note + side, warm, 2.1, 9, .06), .038, side * (12 if n % 2 else 6))
    for step, _ in hits(BASS):
        mix(step, tone(CHORDS[step // 16][0] + (12 if step % 4 else 0), warm, .34, .16), .3)
    for step, note in hits(MELODY):
        pluck = tone(NOTES[note], bright, .8, .17)
        for echo, pan in enumerate((0, .7, -.7, .8, -.8)):
            mix(step + 3 * echo, pluck, .17 * .52 ** echo, pan)
    for step, _ in hits(DRUM):  # all of the above is softer for a moment, which makes room for the drum
        for i in range(int(.22 * RATE)):
            for side in (left, right):
                side[(step * STEP + i) % LENGTH] *= .35 + .65 * (i / (.22 * RATE)) ** 1.5
    drum = [math.sin(2 * math.pi * (48 * t - 5 * math.exp(-t / .028))) * math.exp(-t / .13) * min(1, (.45 - t) / .05)
            for t in (i / RATE for i in range(int(.45 * RATE)))]
    for step, _ in hits(DRUM):
        mix(step, drum, .8)
    clap, open_hat, closed_hat = noise(.25, .07, 1), noise(.12, .045, 2), noise(.12, .018, 2)
    for step, _ in hits(CLAP):
        for late, pan in ((0, -.4), (.09, .4), (.18, 0)):
            mix(step + late, clap, .11, pan)
    for step, _ in hits(HAT):
        mix(step, *((open_hat, .05) if step % 4 == 2 else (closed_hat, .03)), .3)
    with wave.open(str(FOLDER / "beat.wav"), "wb") as out:
        out.setnchannels(2), out.setsampwidth(2), out.setframerate(RATE)
        both = (sample for pair in zip(left, right) for sample in pair)
        out.writeframes(array.array("h", (round(32767 * .92 * math.tanh(1.6 * v)) for v in both)).tobytes())


# The tracks: lists of keys (row, value, way to the next key), by name.
tracks = {}


def pulses(name, rows, high, low, fall):
    """Makes a track that is high in some rows and returns to low within `fall` rows, fast at first."""
    values = [low] * (ROWS + 1)
    for row in rows:
        for k in range(min(fall, ROWS - row)):
            values[row + k] = low + (high - low) * max(1 - 1.8 * k / fall, .6 - .6 * k / fall)
    bends = [r for r in range(1, ROWS) if abs(values[r - 1] - 2 * values[r] + values[r + 1]) > 1e-9]
    tracks[name] = [(r, values[r], "linear") for r in (0, *bends, ROWS)]


def around(degrees, distance, height):
    """Returns a point at a distance from the z axis. At 0 degrees it is in front."""
    return distance * math.sin(math.radians(degrees)), -distance * math.cos(math.radians(degrees)), height


# The camera's keys: row, position, look_at, and way. Before a cut it waits for a row. In bars 5 and 6 it goes around by
# one step in each beat.
CAMERA = [(0, (0, -12.5, 2.2), (0, 0, 2.3), "smooth"), (63, (0, -9.5, 1.9), (0, 0, 2.1), "step"),
          (64, (-4.6, -5.8, .7), (-2, -1.5, 1.1), "smooth"), (95, (-.6, -7, .8), (0, 0, 1.4), "step"),
          (96, (0, 14, 3.4), (0, 0, 2.1), "smooth"), (127, (0, 6.9, 2.3), (0, 0, 2.3), "step"),
          *((128 + 8 * k, around(17.5 * k - 70, 11, 3.6), (0, .8, 1.9), "smooth") for k in range(8)),
          (191, around(70, 11, 3.6), (0, .8, 1.9), "step"),
          (192, (2.2, 5.2, 1.6), (0, 0, 2), "smooth"), (223, (-1.8, 4.6, 2.2), (0, 0, 2.2), "step"),
          (224, (-2, -7.4, 1.2), (0, 0, 2.2), "smooth"), (256, (0, -12.5, 2.2), (0, 0, 2.3), "step")]
# The colour of the sky in each bar.
SKY = [(.34, .14, .46), (.14, .20, .52), (.08, .32, .44), (.42, .14, .38),
       (.34, .14, .46), (.14, .20, .52), (.46, .10, .20), (.34, .14, .46)]


def choreograph():
    beats = [2 * step for step, _ in hits(DRUM)]
    pulses("drum", beats, 1.2, .45, 6)
    pulses("clap", [2 * step for step, _ in hits(CLAP)], 1.2, .5, 9)
    pulses("moon", beats, 1.9, 1.5, 6)
    pulses("angle", beats, 58, 61, 6)
    # The ball rises ever slower, in two straight pieces, and falls freely. After the last beat it bounces twice.
    tracks["bounce"] = []
    for row, end in zip(beats + [232], beats[1:] + [232, 236]):
        height, quarter = .02 * (end - row) ** 2, (end - row) // 4
        tracks["bounce"] += [(row, 0, "linear"), (row + quarter, .75 * height, "linear"),
                             (row + 2 * quarter, height, "ramp")]
    tracks["bounce"].append((236, 0, "step"))
    for note in "ACDEG":
        pulses(note, [2 * step for step, played in hits(MELODY) if played.upper() == note], .8, .1, 9)
    for column in range(8):
        rows = [2 * step for step, _ in hits(BASS) if step // 2 % 8 == column]
        pulses(str(column + 1), rows, .65 + .25 * (column % 2), .1, 15)
    for n, color in enumerate(("red", "green", "blue")):
        tracks["sky:" + color] = [(32 * bar, sky[n], "step") for bar, sky in enumerate(SKY)]
    tracks["polish"] = [(64, .25, "smooth"), (128, .45, "step"), (224, .45, "smooth"), (256, .25, "step")]
    for n, axis in enumerate("xyz"):
        tracks["camera:" + axis] = [(row, position[n], way) for row, position, _, way in CAMERA]
        tracks["look:" + axis] = [(row, look_at[n], way) for row, _, look_at, way in CAMERA]
    text = "// The keys of beat.rt: row, value, and the way to the next key. Written by beat.py.\n"
    for name, keys in tracks.items():
        words = "  ".join(f"{row}_{round(value, 3):g}_{way}" for row, value, way in keys)  # lines end between keys
        text += f'track "{name}" {{\n' + textwrap.fill(words, 120, initial_indent="  ", subsequent_indent="  ")
        text += "\n}\n"
    (FOLDER / "beat.tracks").write_text(text.replace("_", " "))


compose()
choreograph()
