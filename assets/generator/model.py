"""A small solid modeller for the bundled scenes.

A scene is made of axis-aligned solids (wound outwards), voids (wound inwards: a room, a niche, a window reveal) and free
polygons (columns, arches). Where two of them touch, a face that looks one way lies on a face that looks the other way:
that part belongs to neither side of the air and is dropped from both. So a table leg cuts its footprint out of the floor
and a door opening cuts itself out of the wall, and what is left is one closed skin around the air.

Afterwards equal corners become one vertex, and a vertex that lies on somebody's edge becomes a corner of it, so that
edges match everywhere (no T-junctions).
"""
import bisect
import math

AXES = "xyz"
FACES = {"left": (0, -1), "right": (0, 1), "bottom": (1, -1), "top": (1, 1), "near": (2, -1), "far": (2, 1)}
DIGITS = 9  # decimals kept of a coordinate


class ModelError(Exception):
    """The scene's description contradicts itself."""


def quantise(value):
    """The coordinate as it is written: rounded, and never -0."""
    return round(value, DIGITS) + 0.0


def number(value):
    """The shortest text of a quantised coordinate."""
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class Model:
    def __init__(self, name, comments):
        """`name` is the stem of the files, `comments` the lines at the head of the OBJ file."""
        self.name = name
        self.comments = comments
        self.materials = {}  # name -> (Kd, Ke, comment)
        self.rects = []      # (group, material or None, axis, sign, offset, (b0, b1), (c0, c1))
        self.polygons = []   # (group, material, smoothing group, points)
        self.current = name

    def material(self, name, kd, ke=(0, 0, 0), comment=""):
        if not all(0 <= k <= 0.9 for k in kd):
            raise ModelError(f"material {name}: reflectance {kd} is not plausible")
        self.materials[name] = (kd, ke, comment)
        return name

    def group(self, name):
        """What is added from now on belongs to this group."""
        self.current = name

    # --- axis-aligned parts -------------------------------------------------------------------------------------------

    def rect(self, axis, sign, offset, b, c, material):
        """A rectangle across `axis`, facing its positive or negative direction. `b` and `c` are its extents along the two
        axes that follow in the cycle x, y, z. Material None: a pure cut, which takes its area from what faces it."""
        b, c = sorted(map(quantise, b)), sorted(map(quantise, c))
        if b[0] == b[1] or c[0] == c[1]:
            raise ModelError(f"group {self.current}: a rectangle without area")
        self.rects.append((self.current, material, axis, sign, quantise(offset), tuple(b), tuple(c)))

    def _box(self, lo, hi, material, inwards, faces):
        for name, (axis, sign) in FACES.items():
            chosen = faces.get(name, material)
            if chosen == "omit":
                continue
            b, c = (axis + 1) % 3, (axis + 2) % 3
            self.rect(axis, -sign if inwards else sign, (hi if sign > 0 else lo)[axis],
                      (lo[b], hi[b]), (lo[c], hi[c]), chosen)

    def solid(self, lo, hi, material, **faces):
        """A box seen from outside. `top="gold"` gives a face another material, `top="omit"` leaves it out."""
        self._box(lo, hi, material, False, faces)

    def void(self, lo, hi, material, **faces):
        """A box of air seen from inside."""
        self._box(lo, hi, material, True, faces)

    # --- free polygons ------------------------------------------------------------------------------------------------

    def polygon(self, points, material, smoothing=0):
        """A planar simple polygon, counter-clockwise seen from its front."""
        self.polygons.append((self.current, material, smoothing, [tuple(map(quantise, p)) for p in points]))

    def lathe(self, x, z, start, bands, sides=16):
        """A body of revolution about the vertical through (x, z). `start` is the first (radius, height); each band is
        (radius, height, material, smoothing group) and leads on from the ring before it. The outside is to the right of
        the way up, so a profile that goes up from its foot is wound outwards. Radius 0 closes an end."""
        def ring(radius, height):
            return [(x + radius * cosine(k, sides), height, z + radius * sine(k, sides)) for k in range(sides)]
        radius, height = start
        for next_radius, next_height, material, smoothing in bands:
            low, high = ring(radius, height), ring(next_radius, next_height)
            for k in range(sides):
                n = (k + 1) % sides
                corners = [low[k], high[k], high[n], low[n]]
                if radius == 0:
                    corners = [low[k], high[k], high[n]]
                elif next_radius == 0:
                    corners = [low[k], high[k], low[n]]
                self.polygon(corners, material, smoothing)
            radius, height = next_radius, next_height

    def square_around_circle(self, x, y, z, half, radius, up, material, sides=16):
        """The square of half width `half` at height y, less the `sides`-gon that a lathe of this radius leaves."""
        corners = [(x + half * sx, y, z + half * sz) for sx, sz in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        circle = [(x + radius * cosine(k, sides), y, z + radius * sine(k, sides)) for k in range(sides)]
        quarter, eighth = sides // 4, sides // 8
        for k in range(4):
            arc = [circle[(eighth + quarter * k + j) % sides] for j in range(quarter + 1)]
            points = [corners[k], corners[(k + 1) % 4]] + arc[::-1]
            self.polygon(points[::-1] if up else points, material)

    # --- from parts to a skin -----------------------------------------------------------------------------------------

    def skin(self):
        """All polygons as (group, material, smoothing group, points), contacts removed, edges matched."""
        faces = list(self.polygons)
        planes = {}
        for rect in self.rects:
            planes.setdefault((rect[2], rect[4]), []).append(rect)
        for (axis, offset), rects in sorted(planes.items()):
            faces += resolve_plane(axis, offset, rects)
        order = {name: k for k, name in enumerate(self.materials)}
        groups = {}
        for rect in self.rects + self.polygons:
            groups.setdefault(rect[0], len(groups))
        faces.sort(key=lambda f: (groups[f[0]], order[f[1]], f[2]))
        return match_edges(faces)

    def write(self, folder):
        """Writes NAME.obj and NAME.mtl, and returns the number of polygons."""
        faces = self.skin()
        used = {face[1] for face in faces}
        lines = [f"# {line}".rstrip() for line in self.comments]
        lines += [f"# {len(faces)} polygons.", f"mtllib {self.name}.mtl"]
        index = {}
        for _, _, _, points in faces:
            for point in points:
                if point not in index:
                    index[point] = len(index) + 1
                    lines.append("v " + " ".join(map(number, point)))
        group = material = smoothing = None
        for face in faces:
            if face[0] != group:
                group = face[0]
                lines.append(f"g {group}")
            if face[1] != material:
                material = face[1]
                lines.append(f"usemtl {material}")
            if face[2] != smoothing:
                smoothing = face[2]
                lines.append(f"s {smoothing or 'off'}")
            lines.append("f " + " ".join(str(index[point]) for point in face[3]))
        (folder / f"{self.name}.obj").write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")

        lines = [f"# Materials of {self.name}.obj. Kd: diffuse reflectance; Ke: emitted radiosity E [W/m^2]."]
        for name, (kd, ke, comment) in self.materials.items():
            if name in used:
                lines += ["", f"# {comment}"] if comment else [""]
                lines += [f"newmtl {name}", "Kd " + " ".join(map(number, kd)), "Ke " + " ".join(map(number, ke)),
                          "illum 1"]
        (folder / f"{self.name}.mtl").write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")
        return len(faces)


def cosine(k, sides):
    """Cosine of k sides of a turn, exact where it is 0 or 1."""
    k %= sides
    if 4 * k % sides == 0:
        return (1.0, 0.0, -1.0, 0.0)[4 * k // sides]
    return math.cos(2 * math.pi * k / sides)


def sine(k, sides):
    return cosine(k - sides // 4, sides)


def resolve_plane(axis, offset, rects):
    """The rectangles of one plane less their contacts: what faces both ways is dropped."""
    bs = sorted({v for r in rects for v in r[5]})
    cs = sorted({v for r in rects for v in r[6]})
    cells = {1: {}, -1: {}}
    for group, material, _, sign, _, b, c in rects:
        for i in range(bisect.bisect_left(bs, b[0]), bisect.bisect_left(bs, b[1])):
            for j in range(bisect.bisect_left(cs, c[0]), bisect.bisect_left(cs, c[1])):
                if (i, j) in cells[sign]:
                    raise ModelError(f"{group} lies on {cells[sign][i, j][0]}, both facing {'-+'[sign > 0]}{AXES[axis]}, "
                                     f"at {AXES[axis]} = {offset}, about ({bs[i]}, {cs[j]})")
                cells[sign][i, j] = (group, material)
    faces = []
    for sign in (1, -1):
        regions = {}
        for cell, key in cells[sign].items():
            if cell not in cells[-sign] and key[1] is not None:
                regions.setdefault(key, set()).add(cell)
        for (group, material), region in regions.items():
            by_rows = strips(region)
            by_columns = [(j0, j1, i0, i1) for i0, i1, j0, j1 in strips({(j, i) for i, j in region})]
            for i0, i1, j0, j1 in sorted(min(by_rows, by_columns, key=len)):
                corners = [(bs[i0], cs[j0]), (bs[i1], cs[j0]), (bs[i1], cs[j1]), (bs[i0], cs[j1])]
                points = []
                for b, c in corners if sign > 0 else corners[::-1]:
                    point = [0.0, 0.0, 0.0]
                    point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = offset, b, c
                    points.append(tuple(point))
                faces.append((group, material, 0, points))
    return faces


def strips(region):
    """Cells (i, j) as few rectangles (i0, i1, j0, j1): runs along i, then equal runs above each other joined."""
    rows = {}
    for i, j in region:
        rows.setdefault(j, []).append(i)
    done, open_runs, last = [], {}, None
    for j in sorted(rows):
        runs, start, previous = [], None, None
        for i in sorted(rows[j]):
            if previous is None or i != previous + 1:
                if start is not None:
                    runs.append((start, previous + 1))
                start = i
            previous = i
        runs.append((start, previous + 1))
        still_open = {}
        for run in runs:
            still_open[run] = open_runs.pop(run) if last == j - 1 and run in open_runs else j
        done += [(run[0], run[1], j0, last + 1) for run, j0 in open_runs.items()]
        open_runs, last = still_open, j
    return done + [(run[0], run[1], j0, last + 1) for run, j0 in open_runs.items()]


def match_edges(faces):
    """Makes every vertex that lies on an edge a corner of the polygon, so that neighbours share whole edges."""
    points = sorted({point for face in faces for point in face[3]})
    lines = {}  # (axis, the two other coordinates) -> sorted coordinates along the axis
    for p in points:
        for axis in range(3):
            lines.setdefault((axis, p[(axis + 1) % 3], p[(axis + 2) % 3]), []).append(p[axis])
    for along in lines.values():
        along.sort()
    result = []
    for group, material, smoothing, corners in faces:
        matched = []
        for a, b in zip(corners, corners[1:] + corners[:1]):
            matched.append(a)
            differing = [k for k in range(3) if a[k] != b[k]]
            if len(differing) == 1:
                axis = differing[0]
                along = lines[(axis, a[(axis + 1) % 3], a[(axis + 2) % 3])]
                low, high = min(a[axis], b[axis]), max(a[axis], b[axis])
                between = along[bisect.bisect_right(along, low):bisect.bisect_left(along, high)]
                for v in between if a[axis] < b[axis] else between[::-1]:
                    matched.append(a[:axis] + (v,) + a[axis + 1:])
            else:
                matched += points_on_slanted_edge(a, b, points)
        result.append((group, material, smoothing, matched))
    return result


def points_on_slanted_edge(a, b, points, tolerance=1e-7):
    low, high = min(a[0], b[0]) - tolerance, max(a[0], b[0]) + tolerance
    d = [b[k] - a[k] for k in range(3)]
    length2 = sum(v * v for v in d)
    found = []
    for k in range(bisect.bisect_left(points, (low,)), len(points)):
        p = points[k]
        if p[0] > high:
            break
        t = sum((p[k] - a[k]) * d[k] for k in range(3)) / length2
        if 0 < t < 1 and p != a and p != b:
            if sum((a[k] + t * d[k] - p[k]) ** 2 for k in range(3)) < tolerance * tolerance * max(1.0, length2):
                found.append((t, p))
    return [p for _, p in sorted(found)]
