"""Pieces that more than one scene, or one scene more than once, is furnished with. Lengths in metres."""
from math import acos, cos, pi, sin

from .model import FACES


class Frame:
    """A local frame on a model: moved, and turned about the vertical by quarters (0: local z is world z; 1: local z is
    world x). Boxes are given in local coordinates."""

    def __init__(self, model, x, y, z, quarters=0):
        self.model, self.origin, self.quarters = model, (x, y, z), quarters % 4

    def point(self, p):
        x, y, z = p
        for _ in range(self.quarters):
            x, z = z, -x
        return (x + self.origin[0], y + self.origin[1], z + self.origin[2])

    def _turned(self, lo, hi, faces):
        a, b = self.point(lo), self.point(hi)
        named = {}
        for name, material in faces.items():
            axis, sign = FACES[name]
            tip = [0, 0, 0]
            tip[axis] = sign
            tip = [u - v for u, v in zip(self.point(tip), self.origin)]
            named[next(n for n, (k, s) in FACES.items() if tip[k] * s > 0.5)] = material
        return tuple(map(min, a, b)), tuple(map(max, a, b)), named

    def solid(self, lo, hi, material, **faces):
        lo, hi, faces = self._turned(lo, hi, faces)
        self.model.solid(lo, hi, material, **faces)

    def void(self, lo, hi, material, **faces):
        lo, hi, faces = self._turned(lo, hi, faces)
        self.model.void(lo, hi, material, **faces)

    def frame(self, x, y, z, quarters=0):
        return Frame(self.model, *self.point((x, y, z)), self.quarters + quarters)


def skirting(m, lo, hi, height, depth, material, gaps=()):
    """A board along the foot of the walls of a rectangular room. `lo` and `hi` are (x, z) of its corners; gaps are
    (wall, from, to) with the walls left (x low), right, near (z low) and far; from and to are x or z."""
    (x0, z0), (x1, z1) = lo, hi
    for wall in ("near", "far", "left", "right"):
        along_x = wall in ("near", "far")
        start, end = (x0, x1) if along_x else (z0 + depth, z1 - depth)
        cuts = sorted((a, b) for name, a, b in gaps if name == wall)
        for a, b in zip([start] + [b for _, b in cuts], [a for a, _ in cuts] + [end]):
            if b - a < 1e-6:
                continue
            if along_x:
                z = (z0, z0 + depth) if wall == "near" else (z1 - depth, z1)
                m.solid((a, 0, z[0]), (b, height, z[1]), material)
            else:
                x = (x0, x0 + depth) if wall == "left" else (x1 - depth, x1)
                m.solid((x[0], 0, a), (x[1], height, b), material)


def casing(f, width, height, board, depth, material):
    """A door frame on a wall: the opening runs from -width/2 to width/2 along local x, the wall is z = 0."""
    half = width / 2
    f.solid((-half - board, 0, 0), (-half, height, depth), material)
    f.solid((half, 0, 0), (half + board, height, depth), material)
    f.solid((-half - board, height, 0), (half + board, height + board, depth), material)


def chair(f, frame_material, seat_material, seat=.45, back=.95):
    """Stands on local y = 0, centred, its back at z = -0.22; one sits looking along +z."""
    for x in (-.22, .18):
        for z in (-.22, .18):
            f.solid((x, 0, z), (x + .04, seat - .07, z + .04), frame_material)
        f.solid((x, seat - .01, -.22), (x + .04, back, -.18), frame_material)
    f.solid((-.22, seat - .07, -.22), (.22, seat - .01, .22), frame_material)
    f.solid((-.18, seat - .01, -.18), (.20, seat + .02, .21), seat_material)
    f.solid((-.18, back - .14, -.215), (.18, back - .02, -.19), frame_material)
    f.solid((-.18, back - .30, -.21), (.18, back - .24, -.19), frame_material)


def table(f, length, width, height, material, leg=.06, top=.04, apron=.08):
    """Four legs; stands on local y = 0, centred, its length along x."""
    x, z, under = length / 2, width / 2, height - top
    f.solid((-x, under, -z), (x, height, z), material)
    inset = .04
    x, z = x - inset, z - inset
    for sx in (-1, 1):
        for sz in (-1, 1):
            f.solid((min(sx * x, sx * (x - leg)), 0, min(sz * z, sz * (z - leg))),
                    (max(sx * x, sx * (x - leg)), under, max(sz * z, sz * (z - leg))), material)
    for s in (-1, 1):
        a, b = sorted((s * (z - .015), s * (z - .04)))
        f.solid((-x + leg, under - apron, a), (x - leg, under, b), material)
        a, b = sorted((s * (x - .015), s * (x - .04)))
        f.solid((a, under - apron, -z + leg), (b, under, z - leg), material)


def picture(f, width, height, frame_material, canvas, board=.06, depth=.04):
    """Hangs on the wall z = 0 with its middle at the local origin. `canvas` is a list of (x0, x1, y0, y1, material),
    fractions of the canvas, which they must cover."""
    x, y = width / 2, height / 2
    f.solid((-x, -y, 0), (x, y, depth), frame_material)
    x, y = x - board, y - board
    f.void((-x, -y, .02), (x, y, depth), frame_material, near="omit")
    for x0, x1, y0, y1, material in canvas:
        lo = (-x + 2 * x * x0, -y + 2 * y * y0, 0)
        hi = (-x + 2 * x * x1, -y + 2 * y * y1, .02)
        f.solid(lo, hi, material, near="omit", left="omit", right="omit", bottom="omit", top="omit")


def sphere_bands(radius, centre, foot_radius, material, smoothing, rings=8, top_radius=0):
    """Bands of a lathe that continue a stem of `foot_radius` into a sphere; top_radius 0 closes it at the pole."""
    start = acos(foot_radius / radius)  # the stem enters the sphere at this angle below its middle
    end = acos(top_radius / radius) if top_radius else pi / 2
    bands = []
    for k in range(1, rings + 1):
        angle = -start + (start + end) * k / rings
        closing = k == rings and not top_radius
        bands.append((0 if closing else radius * cos(angle), centre + radius * sin(angle), material, smoothing))
    return -radius * sin(start), bands


def books(f, width, depth, tallest, choose, materials, sizes=((.20, .15), (.23, .17), (.26, .19), (.29, .21))):
    """Books side by side from local x = 0 to `width`, standing on y = 0 against z = 0 (the shelf's back) and at most
    `depth` deep and `tallest` high. `choose(n)` gives a number below n."""
    x = 0.0
    usable = [s for s in sizes if s[0] <= tallest and s[1] <= depth]
    while width - x > 1e-6:
        volumes = 1 if choose(3) else 2 + choose(3)  # single books, and sets in one colour
        height, thick = usable[choose(len(usable))]
        spine = .04 + .01 * choose(5)
        material = materials[choose(len(materials))]
        for _ in range(volumes):
            end = x + spine if width - x - spine >= .03 else width
            f.solid((x, 0, 0), (end, height, thick), material)
            x = end
            if width - x <= 1e-6:
                break


class Chooser:
    """Choices that look like chance and are the same on every machine: chooser(n) gives a number below n."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self, n):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2 ** 64
        return (self.state >> 33) % n


def sofa(f, width, cloth, foot, seats=2):
    """Stands on local y = 0 with its back along z = 0, centred in x; one sits looking along +z. One seat: an armchair."""
    half, depth, arm = width / 2, .85, .18
    for x in (-half + .04, half - .10):
        for z in (.06, depth - .12):
            f.solid((x, 0, z), (x + .06, .10, z + .06), foot)
    f.solid((-half, .10, 0), (half, .38, depth), cloth)
    f.solid((-half, .38, 0), (half, .84, .22), cloth)
    for x in (-half, half - arm):
        f.solid((x, .38, .22), (x + arm, .60, depth), cloth)
    seat = (width - 2 * arm - .02 * (seats - 1)) / seats
    for k in range(seats):
        x = -half + arm + k * (seat + .02)
        f.solid((x, .38, .22), (x + seat, .48, depth - .02), cloth)


AMPHORA = ((.30, .06), (.95, .42), (1.0, .55), (.80, .72), (.36, .84), (.34, .92), (.50, 1.0))
URN = ((.35, .05), (.22, .12), (.85, .40), (1.0, .62), (.95, .75), (.70, .82), (.85, 1.0))
BUST = ((.35, .10), (.62, .22), (1.0, .46), (.42, .58), (.40, .64), (.64, .75), (.64, .85), (.45, .96), (.20, 1.0))


def turned(m, x, y, z, radius, height, shape, material, sides=8):
    """A turned body on a square foot: a vase, an urn, something like a bust. `shape`: (radius, height) as fractions."""
    foot = .02
    first = shape[0][0] * radius
    m.solid((x - first * 1.25, y, z - first * 1.25), (x + first * 1.25, y + foot, z + first * 1.25), material, top="omit")
    m.square_around_circle(x, y + foot, z, first * 1.25, first, True, material, sides)
    bands = [(r * radius, y + foot + h * (height - foot), material, 7) for r, h in shape]
    m.lathe(x, z, (first, y + foot), bands + [(0, y + height, material, 0)], sides)


def lamp(m, x, y, z, stem_height, shade, stem_material, shade_material, sides=8):
    """A lamp with a glowing shade; `shade` is (lower radius, upper radius, height). For a table or, tall, for the floor."""
    foot, stem = (.07, .012) if stem_height < .6 else (.14, .016)
    low, high, tall = shade
    m.solid((x - foot, y, z - foot), (x + foot, y + .02, z + foot), stem_material, top="omit")
    m.square_around_circle(x, y + .02, z, foot, stem, True, stem_material, sides)
    top = y + stem_height
    m.lathe(x, z, (stem, y + .02), [(stem, top, stem_material, 8), (low, top, shade_material, 0),
                                    (high, top + tall, shade_material, 9), (0, top + tall, shade_material, 0)], sides)
