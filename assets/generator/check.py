"""Reads a written scene back and says what is wrong with it: what a careful buyer of the model would look for."""
from collections import Counter, defaultdict
from math import sqrt

LENGTH_TOLERANCE = 1e-6  # of the scene's size
RAYS_PER_FACE = 4


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return sqrt(dot(a, a))


class Face:
    def __init__(self, number, group, material, indices, points):
        self.number, self.group, self.material, self.indices, self.points = number, group, material, indices, points
        n = (0, 0, 0)
        for a, b in zip(points, points[1:] + points[:1]):
            c = cross(sub(a, points[0]), sub(b, points[0]))
            n = (n[0] + c[0], n[1] + c[1], n[2] + c[2])
        self.area = norm(n) / 2
        self.normal = tuple(v / (2 * self.area) for v in n) if self.area > 0 else (0, 0, 0)
        self.offset = dot(self.normal, points[0])
        self.low = tuple(min(p[k] for p in points) for k in range(3))
        self.high = tuple(max(p[k] for p in points) for k in range(3))
        drop = max(range(3), key=lambda k: abs(self.normal[k]))
        self.axes = ((drop + 1) % 3, (drop + 2) % 3) if self.normal[drop] > 0 else ((drop + 2) % 3, (drop + 1) % 3)

    def __str__(self):
        return f"face {self.number} ({self.group}, {self.material})"

    def flat(self, axes=None):
        u, v = axes or self.axes
        return [(p[u], p[v]) for p in self.points]

    def triangles(self):
        """Ears as triples of corner numbers; the polygon is simple and counter-clockwise in `axes`."""
        flat, left, ears = self.flat(), list(range(len(self.points))), []
        while len(left) > 3:
            best = None
            for k in range(len(left)):
                a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
                size = turn(flat[a], flat[b], flat[c])
                if size <= 1e-12 * self.area:
                    continue
                if any(inside(flat[p], flat[a], flat[b], flat[c]) for p in left if p not in (a, b, c)):
                    continue
                if best is None or size > best[0]:
                    best = (size, k, (a, b, c))
            if best is None:
                # Only collinear corners are left to take away: they make no triangle.
                best = min((abs(turn(flat[left[k - 1]], flat[left[k]], flat[left[(k + 1) % len(left)]])), k, None)
                           for k in range(len(left)))
                if best[0] > 1e-9 * self.area:
                    return None
            if best[2]:
                ears.append(best[2])
            del left[best[1]]
        if turn(*(flat[k] for k in left)) > 1e-12 * self.area:
            ears.append(tuple(left))
        return ears


def area_of(flat):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(flat, flat[1:] + flat[:1])) / 2


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def inside(p, a, b, c):
    """Whether p lies in the triangle, its border included."""
    return turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0


def read(path):
    vertices, faces, materials = [], [], set()
    group = material = ""
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append(tuple(map(float, words[1:4])))
        elif words[0] == "g":
            group = words[1]
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            indices = tuple(int(w) - 1 for w in words[1:])
            faces.append(Face(len(faces) + 1, group, material, indices, [vertices[i] for i in indices]))
    defined = {}
    for line in path.with_suffix(".mtl").read_text(encoding="ascii").splitlines():
        words = line.split("#")[0].split()
        if words and words[0] == "newmtl":
            defined[words[1]] = materials = {}
        elif words:
            materials[words[0]] = tuple(map(float, words[1:]))
    return vertices, faces, defined


def area_of_overlap(p, q):
    """Area common to two counter-clockwise triangles."""
    polygon = list(p)
    for a, b in zip(q, q[1:] + q[:1]):
        clipped = []
        for c, d in zip(polygon, polygon[1:] + polygon[:1]):
            s, t = turn(a, b, c), turn(a, b, d)
            if s >= 0:
                clipped.append(c)
            if (s > 0 > t) or (s < 0 < t):
                clipped.append((c[0] + (d[0] - c[0]) * s / (s - t), c[1] + (d[1] - c[1]) * s / (s - t)))
        polygon = clipped
        if len(polygon) < 3:
            return 0.0
    return area_of(polygon)


class Boxes:
    """A tree of bounding boxes, for rays and for neighbours."""

    def __init__(self, items):  # (low, high, payload)
        self.low = tuple(min(i[0][k] for i in items) for k in range(3))
        self.high = tuple(max(i[1][k] for i in items) for k in range(3))
        self.items, self.children = items, ()
        if len(items) > 6:
            axis = max(range(3), key=lambda k: self.high[k] - self.low[k])
            items = sorted(items, key=lambda i: i[0][axis] + i[1][axis])
            half = len(items) // 2
            self.items, self.children = (), (Boxes(items[:half]), Boxes(items[half:]))

    def touching(self, low, high, found):
        if any(self.low[k] > high[k] or self.high[k] < low[k] for k in range(3)):
            return found
        for l, h, payload in self.items:
            if all(l[k] <= high[k] and h[k] >= low[k] for k in range(3)):
                found.append(payload)
        for child in self.children:
            child.touching(low, high, found)
        return found

    def along_ray(self, origin, inverse, reach, found):
        near, far = 0.0, reach
        for k in range(3):
            t0, t1 = (self.low[k] - origin[k]) * inverse[k], (self.high[k] - origin[k]) * inverse[k]
            near, far = max(near, min(t0, t1) - 1e-9), min(far, max(t0, t1) + 1e-9)
        if near > far:
            return found
        found += [payload for _, _, payload in self.items]
        for child in self.children:
            child.along_ray(origin, inverse, reach, found)
        return found


def first_hit(tree, origin, direction, start, own):
    inverse = tuple(1 / v if abs(v) > 1e-300 else 1e300 for v in direction)
    best, hit = 1e300, None
    for face, (a, b, c) in tree.along_ray(origin, inverse, 1e300, []):
        slope = dot(direction, face.normal)
        if face is own or abs(slope) < 1e-12:
            continue
        t = (face.offset - dot(origin, face.normal)) / slope
        if start < t < best:
            u, v = face.axes
            p = (origin[u] + t * direction[u], origin[v] + t * direction[v])
            if inside(p, a, b, c):
                best, hit = t, face
    return best, hit


class Random:
    """A small generator of our own, so that a check says the same on every machine."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2 ** 64
        return (self.state >> 11) / 2 ** 53


def check(path, closed, at_least=0):
    """Returns (list of problems, line of figures). `closed`: no ray may leave the scene from the front of a face."""
    vertices, faces, materials = read(path)
    problems = []
    size = max(max(v[k] for v in vertices) - min(v[k] for v in vertices) for k in range(3))
    eps = LENGTH_TOLERANCE * size
    problems += check_vertices_and_materials(vertices, faces, materials)
    shapes = check_shapes(faces, eps)
    problems += shapes
    if shapes:
        return problems, "not examined further"
    triangles = {face: [tuple(face.flat()[k] for k in ear) for ear in face.triangles()] for face in faces}
    tree = Boxes([(face.low, face.high, face) for face in faces])
    problems += check_overlaps(faces, tree, eps)
    problems += check_piercing(faces, tree, triangles, eps)
    edge_problems, edge_figures = check_edges(vertices, faces, closed, eps)
    problems += edge_problems
    side_problems, escaped = check_sides(faces, triangles, closed, eps)
    problems += side_problems
    if len(faces) < at_least:
        problems.append(f"only {len(faces)} polygons, {at_least} are asked for")
    figures = (f"{len(faces)} polygons, {sum(map(len, triangles.values()))} triangles, {len(vertices)} vertices, "
               f"{len({f.material for f in faces})} materials, {edge_figures}, {escaped:.1%} of rays escape")
    return problems, figures


def check_vertices_and_materials(vertices, faces, materials):
    problems = []
    if len(set(vertices)) != len(vertices):
        problems.append("equal vertices are not welded")
    if len({i for face in faces for i in face.indices}) != len(vertices):
        problems.append("a vertex belongs to no face")
    for name in {face.material for face in faces} - materials.keys():
        problems.append(f"material {name} is not defined")
    for name, material in materials.items():
        if not all(0.02 <= k <= 0.9 for k in material["Kd"]):
            problems.append(f"material {name}: Kd {material['Kd']} is outside 0.02..0.9")
    if not any(any(material["Ke"]) for material in materials.values()):
        problems.append("nothing emits")
    return problems


def check_shapes(faces, eps):
    problems, seen = [], {}
    for face in faces:
        n = len(face.indices)
        if n < 3 or len(set(face.indices)) != n or face.area < eps * eps:
            problems.append(f"{face} is degenerate")
            continue
        key = frozenset(face.indices)
        if key in seen:
            problems.append(f"{face} is {seen[key]} again")
        seen[key] = face
        if max(abs(dot(face.normal, p) - face.offset) for p in face.points) > eps / 10:
            problems.append(f"{face} is not planar")
        flat = face.flat()
        edges = list(zip(flat, flat[1:] + flat[:1]))
        for i in range(n):
            for j in range(i + 2, n - (i == 0)):
                (a, b), (c, d) = edges[i], edges[j]
                if turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0:
                    problems.append(f"{face} crosses itself")
        ears = face.triangles()
        if ears is None or abs(sum(turn(*(flat[k] for k in ear)) for ear in ears) / 2 - abs(area_of(flat))) > 1e-9 * face.area:
            problems.append(f"{face} cannot be cut into triangles")
    return problems


def check_overlaps(faces, tree, eps):
    problems = []
    for face in faces:
        low, high = tuple(v - eps for v in face.low), tuple(v + eps for v in face.high)
        for other in tree.touching(low, high, []):
            if other.number <= face.number or abs(dot(face.normal, other.normal)) < 1 - 1e-9:
                continue
            if max(abs(dot(face.normal, p) - face.offset) for p in other.points) > eps:
                continue
            common = 0.0
            mine, theirs = face.flat(), other.flat(face.axes)
            for ear in face.triangles():
                for other_ear in other.triangles():
                    a, b = [mine[k] for k in ear], [theirs[k] for k in other_ear]
                    common += area_of_overlap(a, b if turn(*b) > 0 else b[::-1])
            if common > eps * min(sqrt(face.area), sqrt(other.area)):
                problems.append(f"{face} and {other} lie on each other over an area of {common:.3g}")
    return problems


def check_piercing(faces, tree, triangles, eps):
    """No edge may go through the inside of a face."""
    problems = set()
    for face in faces:
        for a, b in zip(face.points, face.points[1:] + face.points[:1]):
            low = tuple(min(a[k], b[k]) for k in range(3))
            high = tuple(max(a[k], b[k]) for k in range(3))
            for other in tree.touching(low, high, []):
                s, t = dot(other.normal, a) - other.offset, dot(other.normal, b) - other.offset
                if other is face or not (s < -eps and t > eps or s > eps and t < -eps):
                    continue
                u, v = other.axes
                p = tuple(a[k] + (b[k] - a[k]) * s / (s - t) for k in (u, v))
                if any(turn(x, y, p) > 0 and turn(y, z, p) > 0 and turn(z, x, p) > 0 for x, y, z in triangles[other]):
                    problems.add(f"{face} goes through {other}")
    return sorted(problems)


def check_edges(vertices, faces, closed, eps):
    problems, directed, uses = [], Counter(), Counter()
    for face in faces:
        for a, b in zip(face.indices, face.indices[1:] + face.indices[:1]):
            directed[a, b] += 1
            uses[min(a, b), max(a, b)] += 1
    unbalanced = [edge for edge in uses if directed[edge] != directed[edge[::-1]]]
    if closed and unbalanced:
        a, b = unbalanced[0]
        problems.append(f"{len(unbalanced)} edges are open or join faces of opposite winding, for one "
                        f"{vertices[a]} to {vertices[b]}")
    tree = Boxes([(v, v, k) for k, v in enumerate(vertices)])
    junctions = 0
    for i, j in uses:
        a, b = vertices[i], vertices[j]
        d = sub(b, a)
        length2 = dot(d, d)
        low = tuple(min(a[k], b[k]) - eps / 10 for k in range(3))
        high = tuple(max(a[k], b[k]) + eps / 10 for k in range(3))
        for k in tree.touching(low, high, []):
            if k not in (i, j):
                t = dot(sub(vertices[k], a), d) / length2
                if 0 < t < 1 and norm(sub(vertices[k], tuple(a[m] + t * d[m] for m in range(3)))) < eps / 10:
                    junctions += 1
                    if junctions == 1:
                        problems.append(f"T-junction: vertex {vertices[k]} lies on the edge {a} to {b}")
    counts = Counter(uses.values())
    return problems, (f"edges with 1/2/3+ faces {counts[1]}/{counts[2]}/{sum(n for k, n in counts.items() if k > 2)}, "
                      f"{junctions} T-junctions")


def check_sides(faces, triangles, closed, eps):
    """From the front of a face one sees only fronts; in a closed scene one always sees something."""
    tree = Boxes([(face.low, face.high, (face, t)) for face in faces for t in triangles[face]])
    random, problems, rays, escaped, wrong = Random(7), [], 0, 0, defaultdict(int)
    for face in faces:
        for _ in range(RAYS_PER_FACE):
            ears = face.triangles()
            a, b, c = (face.points[k] for k in ears[int(random() * len(ears))])
            s, t = random(), random()
            if s + t > 1:
                s, t = 1 - s, 1 - t
            origin = tuple(a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) for k in range(3))
            direction = (0, 0, 0)
            while not 0.01 < dot(direction, direction) < 1 or dot(direction, face.normal) < 0.1 * norm(direction):
                direction = tuple(2 * random() - 1 for _ in range(3))
            rays += 1
            _, hit = first_hit(tree, origin, direction, eps / 1e4, face)
            if hit is None:
                escaped += 1
            elif dot(hit.normal, direction) > 0:
                wrong[f"{face.group} sees the back of {hit}"] += 1
    problems += list(wrong)[:20]
    if closed and escaped:
        problems.append(f"{escaped} of {rays} rays leave the scene, which is meant to be closed")
    return problems, escaped / rays
