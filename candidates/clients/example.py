"""A textbook engine as a candidate: GJK's and EPA's expanding hull on the Minkowski difference.

touchstone --candidate-command "python3 candidates/clients/example.py" report --count 2
"""

from math import copysign, hypot

from touchstone_candidate import (Box, Candidate, Capsule, Contact, Convex, Cylinder, Plane, Point,
                                  run)


def add(u, v, scale=1.0):
    return (u[0] + scale * v[0], u[1] + scale * v[1], u[2] + scale * v[2])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def support(shape, pose, direction):
    """The shape's point, in the world, farthest in the direction."""
    x, y, z = d = pose.rotate_back(direction)
    match shape:
        case Box(half_extents):
            p = tuple(map(copysign, half_extents, d))
        case Cylinder(radius, half_length):
            scale = radius / (hypot(x, y) or 1)
            p = scale * x, scale * y, copysign(half_length, z)
        case Capsule(radius, half_length):
            p = add((0, 0, copysign(half_length, z)), d, radius / hypot(*d))
        case Convex(vertices):
            p = max(vertices, key=lambda v: dot(v, d))
        case _:
            p = add((0, 0, 0), d, shape.radius / hypot(*d))
    return add(pose.position, pose.rotate(p))


def face(u, v, w):
    """Of a hull's vertices in counterclockwise order: distance from the origin, normal, vertices."""
    n = cross(add(v[0], u[0], -1), add(w[0], u[0], -1))
    n = add((0, 0, 0), n, 1 / hypot(*n))
    return max(dot(n, u[0]), dot(n, v[0]), dot(n, w[0])), n, (u, v, w)


class Example(Candidate):
    name, version = "example-gjk-epa", "1.0"
    settings = "one hull is grown until a face holds to 1e-9; one point, halfway between the bodies"
    pairs = ("cylinder-plane", "cylinder-sphere", "cylinder-capsule", "cylinder-cylinder",
             "cylinder-box", "cylinder-convex")

    def prepare(self, a, b, threshold, parameter):
        return a, b, threshold

    def query(self, prepared, pose_a, pose_b, hint):
        a, b, threshold = prepared
        if isinstance(b, Plane):
            n = pose_b.rotate(b.normal)
            on_a = support(a, pose_a, add((0, 0, 0), n, -1))
            distance = dot(n, add(on_a, pose_b.position, -1)) - b.displacement
            on_b = add(on_a, n, -distance)
            return self.contact(distance, n, on_a, on_b) if distance <= threshold else None

        def vertex(n):
            """Of B minus A, enlarged by the threshold: distances up to it become depths."""
            on_a, on_b = support(a, pose_a, add((0, 0, 0), n, -1)), support(b, pose_b, n)
            return add(add(on_b, on_a, -1), n, threshold), on_a, on_b

        r = 3 ** -0.5
        u, v, w, t = map(vertex, [(r, r, r), (r, -r, -r), (-r, r, -r), (-r, -r, r)])
        hull = [face(u, v, w), face(u, w, t), face(u, t, v), face(v, t, w)]
        for _ in range(300):
            near, n, (u, v, w) = nearest = min(hull)
            p = vertex(n)
            far = dot(n, p[0])
            if far < 0:
                return None
            if far - near <= 1e-9 * min(a):
                break
            seen = {f for f in hull if dot(f[1], p[0]) - f[0] > 1e-11 * min(a)}
            edges = {edge for f in seen for edge in zip(f[2], f[2][1:] + f[2][:1])}
            hull = [f for f in hull if f not in seen]
            hull += [face(*edge, p) for edge in edges if edge[::-1] not in edges]
        foot = add((0, 0, 0), n, near)
        parts = [dot(n, cross(add(i[0], foot, -1), add(j[0], foot, -1)))
                 for i, j in ((v, w), (w, u), (u, v))]
        on_a, on_b = ((0, 0, 0),) * 2
        for part, corner in zip(parts, (u, v, w)):
            on_a, on_b = (add(on, corner[i], part / sum(parts)) for i, on in ((1, on_a), (2, on_b)))
        return self.contact(threshold - far, n, on_a, on_b)

    def contact(self, distance, n, on_a, on_b):
        middle = add(add((0, 0, 0), on_a, 0.5), on_b, 0.5)
        return Contact(distance, n, [Point(middle, n, -distance)])


if __name__ == "__main__":
    run(Example)
