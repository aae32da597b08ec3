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
            {"need": "rolls", "body": "wheel", "share": 0.1},
            {"need": "ends-tilted", "body": "wheel", "degrees": 20},
            {"need": "stays-in", "body": "wheel", "lower": [-1, -0.25, 0.2], "upper": [9, 0.25, 0.6]},
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
                 + [{"need": "ends-near", "body": b, "metres": 0.03} for b in logs]
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
    # The fifth falls from so high that one time in three hundred it bounces off the chute.
    tablets = [p for p in pills if p.startswith("tablet") and p != "tablet-5"]
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
                 + [{"need": "ends-near", "body": c, "metres": 0.02} for c in cans],
        "camera": {"position": [0.75, -1.1, 0.6], "look_at": [0.15, 0, 0.03]},
    }


def product(p, q):
    """Quaternion of turning by q, then by p."""
    w, x, y, z = p
    a, b, d, e = q
    return [round(v, 9) for v in (w * a - x * b - y * d - z * e, w * b + x * a + y * e - z * d,
                                  w * d - x * e + y * a + z * b, w * e + x * d - y * b + z * a)]


def waypoints(*poses):
    """A drive through (time, position[, orientation]), at rest in each."""
    result = []
    for time, position, *orientation in poses:
        pose = {"position": [round(p, 6) for p in position]}
        if orientation:
            pose["orientation"] = orientation[0]
        result.append({"time": time, "pose": pose})
    return {"waypoints": result}


def gripper():
    r, half, top = 0.033, 0.06, 0.1  # of the can; of the tables
    lift, way = 0.12, 0.3
    hand, finger = top + half + 0.09, top + half + 0.005
    bodies = [
        fixed("table", box(0.12, 0.1, 0.05), "wood", (0, 0, 0.05)),
        fixed("shelf", box(0.12, 0.1, 0.05), "wood", (way, 0, 0.05)),
        body("hand", box(0.08, 0.03, 0.02), "steel", (0, 0, hand), drive=waypoints(
            (0.3, (0, 0, hand)), (0.8, (0, 0, hand + lift)), (1.4, (way, 0, hand + lift)),
            (1.9, (way, 0, hand + 0.0005)), (2.1, (way, 0, hand + 0.0005)),
            (2.5, (way, 0, hand + lift)))),
        body("left-finger", box(0.008, 0.015, 0.05), "rubber", (-r - 0.012, 0, finger)),
        body("right-finger", box(0.008, 0.015, 0.05), "rubber", (r + 0.012, 0, finger)),
        body("can", cylinder(r, half), "can", (0, 0, top + half)),
    ]
    motors = {"left": {"position": [[0, 0], [0.2, 0.004], [1.95, 0.004], [2.1, -0.015]],
                       "max_force": 80},
              "right": {"rate": [[0, 0.05], [1.95, 0.05], [1.96, -0.1]], "max_force": 12}}
    joints = [{"joint": "slider", "name": side, "bodies": [f"{side}-finger", "hand"],
               "axis": [1 if side == "left" else -1, 0, 0], "limits": [-0.02, 0.02],
               "motor": motor} for side, motor in motors.items()]
    return {
        "description": "A gripper picks a can from a table, carries it to a shelf, sets it down and "
                       "lets go.",
        "step": 0.002,
        "duration": 3,
        "materials": {"wood": {"friction": 0.5}, "steel": {"friction": 0.4, "density": 7800},
                      "rubber": {"friction": 1, "density": 1200},
                      "can": {"friction": 0.5, "density": 800}},
        "bodies": bodies,
        "joints": joints,
        "needs": [
            {"need": "stands", "body": "can", "degrees": 5},
            {"need": "stays-in", "body": "can", "lower": [way - 0.01, -0.01, top + half - 0.005],
             "upper": [way + 0.01, 0.01, top + half + 0.005], "from": 2.6},
            {"need": "rests", "bodies": ["can"], "speed": 0.005, "by": 2.7},
            {"need": "penetration", "metres": 0.001},
        ],
        "camera": {"position": [0.42, -0.68, 0.42], "look_at": [0.12, 0, 0.17]},
    }


def shelf_push():
    r, half = 0.033, 0.058
    bodies = [
        fixed("shelf", box(0.4, 0.06, 0.01), "wood", (0, 0, -0.01)),
        body("pusher", box(0.01, 0.05, 0.03), "steel", (-0.3, 0, 0.035), drive=waypoints(
            (1, (-0.1, 0, 0.035)), (1.4, (-0.16, 0, 0.035)))),
    ]
    cans = []
    for i in range(3):
        cans.append(f"can-{i + 1}")
        bodies.append(body(cans[-1], cylinder(r, half), "can", (-0.25 + 0.075 * i, 0.002 * i, half)))
    return {
        "description": "A pusher moves a row of three upright cans along a shelf and draws back.",
        "step": 0.002,
        "duration": 2,
        "materials": {"wood": {"friction": 0.4}, "steel": {"friction": 0.3},
                      "can": {"friction": 0.3, "density": 900}},
        "bodies": bodies,
        "needs": [{"need": "stands", "body": c, "degrees": 4} for c in cans]
                 + [{"need": "rests", "bodies": cans, "speed": 0.01, "by": 1.8},
                    {"need": "penetration", "metres": 0.002}]
                 + [{"need": "stays-in", "body": c, "from": 1.8,
                     "lower": [-0.085 + 0.066 * i, -0.05, half - 0.005],
                     "upper": [0.066 * i, 0.05, half + 0.005]}
                    for i, c in enumerate(cans)],
        "camera": {"position": [0.35, -0.7, 0.45], "look_at": [-0.08, 0, 0.04]},
    }


def rover():
    r, width = 0.06, 0.02  # of a wheel: radius and half width
    bodies = [fixed("ground", GROUND, "earth"),
              body("chassis", box(0.16, 0.08, 0.025), "aluminium", (0, 0, r + 0.03))]
    joints = []
    for x, front in ((0.12, "front"), (-0.12, "rear")):
        for y, side in ((0.11, "left"), (-0.11, "right")):
            bodies.append(body(f"{front}-{side}", cylinder(r, width), "rubber", (x, y, r), ALONG_Y))
            joints.append({"joint": "hinge", "name": f"{front}-{side}",
                           "bodies": [f"{front}-{side}", "chassis"], "anchor": [x, y, r],
                           "axis": [0, 1, 0],
                           "motor": {"rate": [[0, 0], [0.5, 8]], "max_force": 1.5}})
    for i, x in enumerate((0.4, 0.65, 0.9)):
        bodies.append(fixed(f"bump-{i + 1}", box(0.03 + 0.01 * i, 0.3, 0.004 + 0.003 * i), "earth",
                            (x, 0, 0)))
    bodies.append(fixed("pipe", cylinder(0.012, 0.3), "earth", (1.15, 0, 0), ALONG_Y))
    return {
        "description": "Four motors drive a rover over three flat bumps and a pipe half in the "
                       "ground.",
        "duration": 3.2,
        "materials": {"earth": {"friction": 0.8}, "rubber": {"friction": 0.9, "density": 1100},
                      "aluminium": {"friction": 0.3, "density": 1500}},
        "bodies": bodies,
        "joints": joints,
        "needs": [
            {"need": "ends-near", "body": "chassis", "metres": 0.05},
            {"need": "ends-tilted", "body": "chassis", "degrees": 3},
            {"need": "stays-in", "body": "chassis", "lower": [-0.1, -0.05, 0.07],
             "upper": [3, 0.05, 0.14]},
            {"need": "stays-in", "body": "chassis", "lower": [1.3, -0.05, 0.08],
             "upper": [1.5, 0.05, 0.1], "from": 3.15},
            {"need": "penetration", "metres": 0.004},
        ],
        "camera": {"position": [1.3, -0.95, 0.5], "look_at": [0.72, 0, 0.03]},
    }


def drum():
    """Granular: an open drum of twelve staves and a back, whose axis leans back by 45 degrees."""
    radius, half, staves, lean = 0.1, 0.06, 12, 45
    c, s = math.cos(math.radians(lean)), math.sin(math.radians(lean))

    def in_drum(x, y, z):
        """A point of the drum's frame, whose y points along the axis into it, in the world."""
        return x, c * y + s * z, -s * y + c * z

    leant = turned([1, 0, 0], -lean)
    bodies = [body("back", cylinder(radius + 0.016, 0.006), "steel", in_drum(0, half + 0.006, 0),
                   product(leant, ALONG_Y),
                   drive={"angular_velocity": [round(4 * v, 9) for v in in_drum(0, 1, 0)]})]
    joints = []
    for i in range(staves):
        angle = 360 * i / staves
        x, z = math.sin(math.radians(angle)), math.cos(math.radians(angle))
        bodies.append(body(f"stave-{i + 1}", box(0.036, half, 0.008), "steel",
                           in_drum((radius + 0.008) * x, 0, (radius + 0.008) * z),
                           product(leant, turned([0, 1, 0], angle))))
        joints.append({"joint": "fixed", "bodies": [f"stave-{i + 1}", "back"]})
    count = 16
    rods = [f"rod-{i + 1}" for i in range(count)]
    return {
        "description": "Sixteen rods, dropped at random, tumble in an open drum that leans and turns.",
        "step": 0.002,
        "duration": 2.5,
        "materials": {"steel": {"friction": 0.5}, "rod": {"friction": 0.4, "density": 1200}},
        "bodies": bodies,
        "drops": [{"name": "rod", "shape": cylinder(0.008, 0.016), "material": "rod",
                   "count": count, "seed": 1, "lower": [-0.045, -0.08, 0.15],
                   "upper": [0.045, -0.02, 0.5]}],
        "joints": joints,
        "needs": [{"need": "stays-in", "body": rod, "lower": [-0.12, -0.12, -0.12],
                   "upper": [0.12, 0.12, 0.12], "from": 1} for rod in rods]
                 + [{"need": "penetration", "metres": 0.006, "from": 1}],
        "camera": {"position": [0.12, -0.42, 0.42], "look_at": [0, 0, -0.01]},
    }


def bowling():
    r, half, tilt, turn = 0.02, 0.04, 6, 30  # of a can; degrees
    away = turned([0, 0, 1], turn)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    ct, st = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))

    def on_tray(x, y, z):
        """A point of the tray's frame in the world: tilted about y, then turned about z."""
        x, z = ct * x + st * z, -st * x + ct * z
        return c * x - s * y, s * x + c * y, z

    level = product(away, turned([0, 1, 0], tilt))
    bodies = [fixed("tray", box(0.45, 0.2, 0.01), "wood", on_tray(0, 0, -0.01), level)]
    cans = []
    for row in range(3):
        for i in range(row + 1):
            cans.append(f"can-{row + 1}{'abc'[i]}")
            bodies.append(body(cans[-1], cylinder(r, half), "can",
                               on_tray(0.1 + 0.055 * row, 0.06 * (i - row / 2), half), level))
    bodies.append(body("roller", cylinder(0.035, 0.05), "steel", on_tray(-0.4, 0.004, 0.036),
                       product(level, ALONG_Y)))
    return {
        "description": "A heavy roller runs down a tilted, turned tray into six standing cans.",
        "step": 0.002,
        "duration": 2,
        "materials": {"wood": {"friction": 0.4}, "steel": {"friction": 0.4, "density": 4000},
                      "can": {"friction": 0.4, "density": 400}},
        "bodies": bodies,
        "needs": [{"need": "stands", "body": can, "degrees": tilt + 1, "until": 0.7} for can in cans]
                 + [{"need": "falls-in-order", "bodies": ["can-1a"], "degrees": 15},
                    {"need": "penetration", "metres": 0.01}],
        "camera": {"position": [0.75, -0.75, 0.5], "look_at": [0, 0, 0]},
    }


def three_logs():
    r, half = 0.1, 0.5
    bodies = [fixed("ground", box(1, 1, 0.1), "earth", (0, 0, -0.1))]
    for name, x in (("left", -1), ("right", 1)):
        bodies.append(body(name, cylinder(r, half), "wood", (x * (r + 1e-4), 0, r), ALONG_Y))
    bodies.append(body("top", cylinder(r, half), "wood", (0, 0.3, r + math.sqrt(3) * r), ALONG_Y))
    return {
        "description": "Two logs carry a third, as they do on paper where friction is above 0.268; it "
                       "lies 0.3 m further along.",
        "duration": 4,
        "materials": {"earth": {"friction": 0.5}, "wood": {"friction": 0.5, "density": 700}},
        "bodies": bodies,
        # Wide across, where capsules let it wander by more than 15 mm in some disturbed runs.
        "needs": [{"need": "stays-in", "body": "top", "lower": [-0.05, 0.285, 0.258],
                   "upper": [0.05, 0.315, 0.285]}],
        "camera": {"position": [1.2, -1.6, 0.9], "look_at": [0, 0, 0.15]},
    }


def rod_on_table():
    r = 0.015
    return {
        "description": "A rod of 15 mm radius lies on a table.",
        "duration": 3,
        "materials": {"wood": {"friction": 0.5}},
        "bodies": [fixed("table", box(0.5, 0.5, 0.05), "wood", (0, 0, -0.05)),
                   body("rod", cylinder(r, 4 * r), "wood", (0, 0, r), ALONG_Y)],
        "needs": [{"need": "ends-near", "body": "rod", "metres": 0.001},
                  {"need": "penetration", "metres": 0.0004}],
    }


def stack_of_cans():
    r = 0.1
    cans = [f"can-{i + 1}" for i in range(5)]
    bodies = [fixed("table", box(0.5, 0.5, 0.05), "tin", (0, 0, -0.05))]
    bodies += [body(c, cylinder(r, r), "tin", (0, 0, r + 2 * r * i)) for i, c in enumerate(cans)]
    return {
        "description": "Five cans stand on each other.",
        "duration": 2,
        "materials": {"tin": {"friction": 0.5}},
        "bodies": bodies,
        "needs": [{"need": "stands", "body": c, "degrees": 1} for c in cans] +
                 [{"need": "penetration", "metres": 0.01}],
        "camera": {"position": [1.6, -2.4, 1.0], "look_at": [0, 0, 0.5]},
    }


SCENES = {"thesis-spheres": thesis_spheres, "thesis-knock": thesis_knock,
          "wheel-on-road": wheel_on_road, "rod-in-corner": rod_in_corner, "log-pile": log_pile,
          "pill-dispenser": pill_dispenser, "conveyor": conveyor, "gripper": gripper,
          "shelf-push": shelf_push, "rover": rover, "drum": drum, "bowling": bowling,
          "three-logs": three_logs, "rod-on-table": rod_on_table,
          "stack-of-cans": stack_of_cans}


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
