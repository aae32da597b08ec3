#!/usr/bin/env python3
"""Writes the scene files beside this script; with --check, only compares them with what it would
write. Lengths in metres, times in seconds."""
import json
import math
import pathlib
import sys

GROUND = {"shape": "plane", "normal": [0, 0, 1], "displacement": 0}
ALONG_X = [0.7071067811865476, 0, 0.7071067811865476, 0]  # turns z to x
ALONG_Y = [0.7071067811865476, -0.7071067811865476, 0, 0]  # turns z to y


def cylinder(radius, half_length):
    return {"shape": "cylinder", "radius": radius, "half_length": half_length}


def box(x, y, z):
    return {"shape": "box", "half_extents": [x, y, z]}


def turned(axis, degrees):
    half = math.radians(degrees) / 2
    norm = math.hypot(*axis)
    return [round(math.cos(half), 9)] + [round(a / norm * math.sin(half), 9) for a in axis]


def body(name, shape, material, position=(0, 0, 0), orientation=None, **more):
    pose = {"position": [round(p, 6) for p in position]}
    if orientation:
        pose["orientation"] = orientation
    return {"name": name, "shape": shape, "material": material, "pose": pose, **more}


def fixed(name, shape, material, position=(0, 0, 0), orientation=None):
    return body(name, shape, material, position, orientation, fixed=True)


def thesis_spheres():
    """Figure 29: a bed of spheres, a cylinder that rolls in, one that falls, one that stands."""
    r, side = 0.1, 6
    bodies = [fixed("ground", GROUND, "ground")]
    for i in range(side):
        for j in range(side):
            x, y = (i - (side - 1) / 2) * 0.2005, (j - (side - 1) / 2) * 0.2005
            bodies.append(body(f"sphere-{i}{j}", {"shape": "sphere", "radius": r}, "ball", (x, y, r)))
    bodies.append(body("rolling", cylinder(0.2, 0.5), "steel", (-1.9, 0.05, 0.2), ALONG_Y,
                       velocity=[5, 0, 0], angular_velocity=[0, 25, 0]))
    bodies.append(body("falling", cylinder(0.15, 0.3), "steel", (-0.1, -0.1, 1.6),
                       turned([0, 1, 0], 60)))
    bodies.append(body("standing", cylinder(0.18, 0.4), "steel", (0.3, 0.1, 2 * r + 0.4)))
    return {
        "description": "A bed of spheres is torn up by a cylinder that rolls in fast and another "
                       "that falls on it; a third, which stands on the spheres, is thrown over.",
        "duration": 2.5,
        "materials": {"ground": {"friction": 0.6}, "ball": {"friction": 0.4, "density": 800},
                      "steel": {"friction": 0.4, "density": 1500}},
        "bodies": bodies,
        "needs": [
            {"need": "stands", "body": "standing", "degrees": 1, "until": 0.2},
            {"need": "falls-in-order", "bodies": ["standing"]},
            {"need": "penetration", "metres": 0.03},
        ],
        "camera": {"position": [1.6, -3.4, 2.0], "look_at": [0, 0, 0.25]},
    }


def thesis_knock():
    """Figure 30: five cylinders fall, stand, and four are knocked away by a sphere from above."""
    bodies = [fixed("ground", GROUND, "ground")]
    h, z = 0.35, 0.38
    bodies.append(body("centre", cylinder(0.15, 0.25), "steel", (0, 0, 0.28), turned([1, 0, 0], 0.1)))
    for i, (x, y) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        bodies.append(body(f"outer-{i + 1}", cylinder(0.12, h), "steel", (0.25 * x, 0.25 * y, z),
                           turned([y, x, 0], 0.1)))
    bodies.append(body("ball", {"shape": "sphere", "radius": 0.3}, "ball", (0.004, 0.002, 3.9)))
    outer = [f"outer-{i}" for i in range(1, 5)]
    return {
        "description": "Five cylinders fall to the ground and stand. A sphere falls between them, "
                       "knocks the four outer ones over, and rolls down from the middle one.",
        "duration": 4,
        "materials": {"ground": {"friction": 0.5}, "ball": {"friction": 0.5, "density": 600},
                      "steel": {"friction": 0.5, "density": 1500}},
        "bodies": bodies,
        "needs": [{"need": "stands", "body": b, "degrees": 0.5, "from": 0.4, "until": 0.7}
                  for b in ["centre"] + outer]
                 + [{"need": "falls-in-order", "bodies": [b]} for b in outer]
                 + [{"need": "stands", "body": "centre", "degrees": 2, "from": 3},
                    {"need": "penetration", "metres": 0.03}],
        "camera": {"position": [1.9, -3.2, 1.7], "look_at": [0, 0, 0.4]},
    }


def wheel_on_road():
    bodies = [fixed("ground", GROUND, "road")]
    sizes = [(0.04, 0.005), (0.06, 0.009), (0.05, 0.014)]  # half width and half height
    for i, size in enumerate([0, 1, 2, 0, 1, 2, 2, 0, 1, 0, 1, 2, 1, 0]):
        bodies.append(fixed(f"bump-{i + 1}", box(sizes[size][0], 0.5, sizes[size][1]), "road",
                            (0.5 + 0.28 * i, 0, 0)))
    bodies.append(body("wheel", cylinder(0.3, 0.06), "rubber", (0, 0, 0.3), ALONG_Y,
                       velocity=[3, 0, 0], angular_velocity=[0, 10, 0]))
    return {
        "description": "A wheel rolls over a road of fourteen flat boxes.",
        "duration": 1.6,
        "materials": {"road": {"friction": 0.9}, "rubber": {"friction": 0.9, "density": 300}},
        "bodies": bodies,
        "needs": [
            {"need": "rolls", "body": "wheel", "share": 0.03},
            {"need": "ends-tilted", "body": "wheel", "degrees": 3},
            {"need": "stays-in", "body": "wheel", "lower": [-1, -0.1, 0.25], "upper": [9, 0.1, 0.5]},
            {"need": "penetration", "metres": 0.01},
        ],
        "camera": {"position": [1.2, -4.2, 1.5], "look_at": [2.2, 0, 0.2]},
    }


def rod_in_corner():
    bodies = [
        fixed("floor", box(0.1, 0.1, 0.01), "steel", (0, 0, -0.01)),
        fixed("back", box(0.1, 0.01, 0.08), "steel", (0, 0.05, 0.08)),
        fixed("side", box(0.01, 0.1, 0.08), "steel", (-0.05, 0, 0.08)),
        body("rod", cylinder(0.008, 0.06), "rod", (-0.012, 0.012, 0.078),
             turned([0.8, 0.6, 0], -24), velocity=[-0.1, 0.1, -0.1]),
    ]
    return {
        "description": "A gripper lets go of a rod, which slides into the corner of a box.",
        "step": 0.002,
        "surface_layer": 2e-5,
        "duration": 1.5,
        "materials": {"steel": {"friction": 0.2}, "rod": {"friction": 0.2, "density": 7800}},
        "bodies": bodies,
        "needs": [
            {"need": "rests", "bodies": ["rod"], "speed": 0.005, "by": 1.3},
            {"need": "ends-near", "body": "rod", "metres": 0.002},
            {"need": "ends-tilted", "body": "rod", "degrees": 2},
            {"need": "normals", "bodies": ["rod", "floor"], "degrees": 5},
            {"need": "penetration", "metres": 0.0015},
        ],
    }


def log_pile():
    r, half = 0.15, 0.8
    bodies = [fixed("ground", GROUND, "earth")]
    for side in (-1, 1):
        for end in (-1, 1):
            bodies.append(fixed(f"post-{'lr'[side > 0]}{'fb'[end > 0]}", box(0.05, 0.05, 0.3), "post",
                                (side * (3 * r + 0.06), end * 0.5, 0.3)))
    logs = []
    for row, count in enumerate((3, 2, 1)):
        for i in range(count):
            logs.append(f"log-{row + 1}{'abc'[i]}")
            askew = 0.4 * (-1) ** (row + i)  # degrees; and not quite in line
            bodies.append(body(logs[-1], cylinder(r, half), "wood",
                               ((i - (count - 1) / 2) * 2 * (r + 0.004), 0.03 * (i - row),
                                r + row * (math.sqrt(3) * r + 0.008) + 0.005),
                               turned([1, 0.02 * askew, 0.02 * askew], -90)))
    return {
        "description": "Six logs settle between four posts.",
        "duration": 2,
        "materials": {"earth": {"friction": 0.6}, "post": {"friction": 0.4},
                      "wood": {"friction": 0.5, "density": 700}},
        "bodies": bodies,
        "needs": [{"need": "rests", "bodies": logs, "speed": 0.1, "by": 1.5}]
                 + [{"need": "ends-near", "body": b, "metres": 0.01} for b in logs]
                 + [{"need": "ends-tilted", "body": "log-3a", "degrees": 1},
                    {"need": "penetration", "metres": 0.006}],
        "camera": {"position": [1.6, -3.0, 1.3], "look_at": [0, 0, 0.3]},
    }


def pill_dispenser():
    bodies = [
        fixed("tray", box(0.06, 0.04, 0.005), "plastic", (0.02, 0, -0.005)),
        fixed("front", box(0.06, 0.005, 0.03), "plastic", (0.02, -0.045, 0.03)),
        fixed("back", box(0.06, 0.005, 0.03), "plastic", (0.02, 0.045, 0.03)),
        fixed("right", box(0.005, 0.04, 0.02), "plastic", (0.085, 0, 0.02)),
        fixed("chute", box(0.06, 0.04, 0.005), "plastic", (-0.055, 0, 0.045), turned([0, 1, 0], 32)),
    ]
    pills = []
    for i in range(10):
        x, y, z = -0.085 + 0.012 * (i % 3), -0.022 + 0.022 * (i % 3), 0.085 + 0.013 * i
        pills.append(f"{'capsule' if i % 2 else 'tablet'}-{i // 2 + 1}")
        shape = ({"shape": "capsule", "radius": 0.003, "half_length": 0.005} if i % 2
                 else cylinder(0.0035, 0.007))
        bodies.append(body(pills[-1], shape, "pill", (x, y, z),
                           turned([0.6, 0.8, 0] if i % 3 else [0, 1, 0], 50 + 23 * i)))
    tablets = [p for p in pills if p.startswith("tablet")]
    return {
        "description": "Capsules and long tablets slide down a chute into a tray.",
        "step": 0.001,
        "surface_layer": 2e-5,
        "duration": 1.5,
        "materials": {"plastic": {"friction": 0.25}, "pill": {"friction": 0.25, "density": 1200}},
        "bodies": bodies,
        "needs": [{"need": "rests", "bodies": tablets, "speed": 0.5, "by": 1.4},
                  {"need": "penetration", "metres": 0.003}]
                 + [{"need": "stays-in", "body": p, "lower": [-0.04, -0.04, 0],
                     "upper": [0.08, 0.04, 0.03], "from": 1.4} for p in tablets],
    }


def conveyor():
    r, half = 0.033, 0.058
    bodies = [
        fixed("belt", box(0.6, 0.08, 0.02), "belt", (0, 0, -0.02)),
        fixed("gate", box(0.01, 0.08, 0.05), "rail", (0.5, 0, 0.05)),
        fixed("left-rail", box(0.6, 0.005, 0.02), "rail", (0, 0.045, 0.05)),
        fixed("right-rail", box(0.6, 0.005, 0.02), "rail", (0, -0.045, 0.05)),
    ]
    cans = []
    for i in range(6):
        cans.append(f"can-{i + 1}")
        bodies.append(body(cans[-1], cylinder(r, half), "can", (0.3 - 0.13 * i, 0.004 * (i % 3 - 1), half),
                           velocity=[1, 0, 0]))
    return {
        "description": "Six cans slide upright down the run-out of a conveyor, up to a gate and "
                       "against each other.",
        "step": 0.002,
        "duration": 2.0,
        "materials": {"belt": {"friction": 0.05}, "rail": {"friction": 0.02},
                      "can": {"friction": 0.1, "density": 900}},
        "bodies": bodies,
        "needs": [{"need": "stands", "body": c, "degrees": 3} for c in cans]
                 + [{"need": "rests", "bodies": cans, "speed": 0.05, "by": 1.9},
                    {"need": "penetration", "metres": 0.004}]
                 + [{"need": "ends-near", "body": c, "metres": 0.005} for c in cans],
        "camera": {"position": [0.75, -1.1, 0.6], "look_at": [0.15, 0, 0.03]},
    }


SCENES = {"thesis-spheres": thesis_spheres, "thesis-knock": thesis_knock,
          "wheel-on-road": wheel_on_road, "rod-in-corner": rod_in_corner, "log-pile": log_pile,
          "pill-dispenser": pill_dispenser, "conveyor": conveyor}


def dump(value, indent=""):
    """JSON with a line for each body, need and material."""
    if not isinstance(value, dict) or indent == "    ":
        return json.dumps(value)
    lines = []
    for key, entry in value.items():
        if isinstance(entry, list) and entry and isinstance(entry[0], dict):
            inner = ",\n".join(f"    {json.dumps(e)}" for e in entry)
            lines.append(f'  "{key}": [\n{inner}\n  ]')
        else:
            lines.append(f'  "{key}": {json.dumps(entry)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"


folder = pathlib.Path(__file__).parent
different = []
for name, make in SCENES.items():
    text = dump({"$schema": "../docs/scene-schema.json", **make()})
    file = folder / f"{name}.json"
    if "--check" not in sys.argv:
        file.write_text(text, encoding="utf-8")
    elif file.read_text(encoding="utf-8") != text:
        different.append(file.name)
if different:
    sys.exit(f"not as make_scenes.py writes them: {', '.join(different)}")
