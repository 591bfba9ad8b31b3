"""A reading room: columns under a coffered ceiling, arched windows, bookcases, a long table, a hearth."""
from math import asin, cos, pi, sin, sqrt

from .furniture import (AMPHORA, BUST, URN, Chooser, Frame, books, casing, chair, lamp, picture, skirting, sofa,
                        sphere_bands, turned)
from .model import Model
from .small_scenes import LICENCE

LENGTH, DEPTH, HEIGHT = 12.0, 8.0, 4.2  # to the underside of the beams
BAY = 2.4
COLUMN_X = [BAY * k for k in range(1, 5)]
COLUMN_Z = (2.0, 6.0)
BAY_X = [BAY * (k + .5) for k in range(5)]
BEAM = .25  # half of a beam's width


def library():
    m = Model("library", [
        "A library: reading room of 12 x 8 m with eight columns. Unit: m, y up. E and B in W/m^2. Closed on all sides.",
        "Teaches: daylight in a building. Three windows of sky light a room that is deep enough to need every bounce:",
        "columns throw soft shadows, the coffers are lit from the floor alone, the carpet reddens the table's underside,",
        "and three lamps and a bed of embers stand against the blue light in a warm one.",
        "Look: --eye 0.7,1.65,4.6 --at 8,1.5,3.7 --fov 62       along the nave, from the door",
        "Look: --eye 10.2,1.8,3.7 --at 3.5,1.3,6.1 --fov 60     from the hearth to the bookcases",
        "Look: --eye 3.6,1.7,5.85 --at 6.2,1.5,1.0 --fov 62     towards the windows",
        "Look: --eye 8.6,1.5,4.7 --at 11.8,1.3,3.9 --fov 60     the hearth",
        "Source: our own. " + LICENCE])
    materials(m)
    shell(m)
    for x in BAY_X[1:4]:
        window(m, x, 1.3, .9, 2.7)
    columns(m)
    walls(m)
    door(m)
    hearth(m)
    choose = Chooser(12)
    for x in BAY_X[1:4]:
        bookcase(m, x, choose)
    reading_table(m, choose)
    things(m)
    return m


def materials(m):
    m.material("plaster", (.71, .63, .49))
    m.material("ceiling", (.80, .78, .73))
    m.material("stone", (.66, .63, .56))
    m.material("marble", (.80, .78, .75))
    m.material("floor", (.50, .43, .34), comment="limestone")
    m.material("floor_band", (.20, .17, .15))
    m.material("frame_paint", (.79, .78, .74))
    m.material("walnut", (.23, .14, .085))
    m.material("oak", (.42, .28, .16))
    m.material("leather", (.12, .23, .15))
    m.material("brass", (.60, .46, .20))
    m.material("carpet", (.46, .09, .075))
    m.material("carpet_border", (.10, .12, .25))
    m.material("carpet_stripe", (.64, .50, .26))
    m.material("paper", (.78, .74, .63))
    m.material("terracotta", (.56, .26, .14))
    m.material("glaze", (.13, .30, .42))
    m.material("sea", (.25, .42, .50))
    m.material("soot", (.07, .065, .06))
    for name, kd in (("book_red", (.42, .08, .06)), ("book_brown", (.33, .20, .11)), ("book_green", (.10, .25, .13)),
                     ("book_blue", (.09, .15, .33)), ("book_ochre", (.60, .42, .15)), ("book_cream", (.72, .66, .52)),
                     ("book_black", (.06, .06, .07)), ("book_plum", (.28, .09, .20))):
        m.material(name, kd)
    m.material("sky", (.05, .05, .05), (11, 14, 19), "window panes: an even sky; what falls on them from inside leaves")
    m.material("lamp_shade", (.70, .62, .48), (28, 19, 9.5))
    m.material("embers", (.12, .08, .06), (16, 4, .7))


def shell(m):
    m.group("room")
    m.void((0, 0, 0), (LENGTH, HEIGHT, DEPTH), "plaster", top="ceiling", bottom="omit")
    m.group("floor")
    band = .30
    edges = [0, COLUMN_Z[0] - band, COLUMN_Z[0] + band, COLUMN_Z[1] - band, COLUMN_Z[1] + band, DEPTH]
    for k in range(5):
        m.rect(1, 1, 0, (edges[k], edges[k + 1]), (0, LENGTH), "floor_band" if k % 2 else "floor")
    m.group("coffers")
    for x in BAY_X:
        for z0, z1 in ((BEAM, 2 - BEAM), (2 + BEAM, 3.85), (4.15, 6 - BEAM), (6 + BEAM, DEPTH - BEAM)):
            x0, x1 = x - BAY / 2 + BEAM, x + BAY / 2 - BEAM
            m.void((x0, HEIGHT, z0), (x1, HEIGHT + .22, z1), "ceiling")
            m.void((x0 + .14, HEIGHT + .22, z0 + .14), (x1 - .14, HEIGHT + .34, z1 - .14), "ceiling")


def window(m, x, width, sill, spring, reveal=.34, bar=.04, arc=5):
    """An arched window in the wall z = 0: sill and springing line at these heights, panes of sky between bars."""
    m.group("windows")
    r, back, glass = width / 2, -reveal + bar, -reveal
    m.void((x - r, sill, back), (x + r, spring, 0), "plaster", near="frame_paint", top="omit", bottom="stone")
    cell_x = [(-r + .06, -.02), (.02, r - .06)]
    pitch = (spring - .03 - sill - .06 + bar) / 3
    for a, b in cell_x:
        for k in range(3):
            y = sill + .06 + k * pitch
            m.void((x + a, y, glass), (x + b, y + pitch - bar, back), "frame_paint", near="sky")
    # The arch: its bounding rectangle is cut from the wall and two spandrels are put back.
    m.rect(2, -1, 0, (x - r, x + r), (spring, spring + r), None)
    inner = r - .06
    outer_arc = [(-r * cos(pi / 2 * k / arc), r * sin(pi / 2 * k / arc)) for k in range(arc + 1)]
    outer_arc[0], outer_arc[-1] = (-r, 0), (0, r)
    first, last = asin(.03 / inner), pi / 2 - asin(.02 / inner)
    angles = [first + (last - first) * k / arc for k in range(arc + 1)]
    pane_arc = [(-inner * cos(a), inner * sin(a)) for a in angles]
    pane_arc[0], pane_arc[-1] = (-sqrt(inner ** 2 - .03 ** 2), .03), (-.02, sqrt(inner ** 2 - .02 ** 2))
    pane = [(-.02, .03)] + pane_arc[::-1]
    for mirror in (1, -1):
        def face(points, material, smoothing=0):
            placed = [(x + mirror * p[0], spring + p[1], p[2]) for p in points]
            m.polygon(placed if mirror > 0 else placed[::-1], material, smoothing)

        def flat(points, z):
            return [(p[0], p[1], z) for p in points]

        face(flat([(-r, r)] + outer_arc, 0), "plaster")
        for a, b in zip(outer_arc, outer_arc[1:]):
            face([(*a, back), (*b, back), (*b, 0), (*a, 0)], "plaster", 1)
        face(flat(pane_arc + outer_arc[::-1], back), "frame_paint")
        face(flat([outer_arc[0], (0, 0), outer_arc[-1], pane_arc[-1], (-.02, .03), pane_arc[0]], back), "frame_paint")
        for a, b in zip(pane, pane[1:] + pane[:1]):
            face([(*b, back), (*b, glass), (*a, glass), (*a, back)], "frame_paint")
        face(flat(pane[::-1], glass)[::-1], "sky")
    m.solid((x - r - .08, sill - .07, 0), (x + r + .08, sill, .10), "stone")


def columns(m):
    m.group("columns")
    abacus, profile = 4.08, [(.285, .20, 1), (.260, .25, 1), (.210, .30, 2), (.175, 3.82, 3),
                             (.200, 3.85, 4), (.175, 3.88, 4), (.185, 3.98, 5), (.225, 4.08, 5)]
    for x in COLUMN_X:
        for z in COLUMN_Z:
            m.solid((x - .3, 0, z - .3), (x + .3, .15, z + .3), "stone", top="omit")
            m.square_around_circle(x, .15, z, .3, .260, True, "stone")
            m.lathe(x, z, (.260, .15), [(r, y, "stone", s) for r, y, s in profile])
            m.square_around_circle(x, abacus, z, .24, .225, False, "stone")
            m.solid((x - .24, abacus, z - .24), (x + .24, HEIGHT, z + .24), "stone", bottom="omit")


def walls(m):
    m.group("pilasters")
    for x in COLUMN_X:
        for f in (Frame(m, x, 0, 0, 0), Frame(m, x, 0, DEPTH, 2)):
            f.solid((-.20, 0, 0), (.20, .25, .10), "stone")
            f.solid((-.17, .25, 0), (.17, HEIGHT - .14, .07), "stone")
            f.solid((-.22, HEIGHT - .14, 0), (.22, HEIGHT, .11), "stone")
    m.group("skirting")
    near = [("near", x - .20, x + .20) for x in COLUMN_X]
    far = [("far", x - .20, x + .20) for x in COLUMN_X] + [("far", x - .95, x + .95) for x in BAY_X[1:4]]
    skirting(m, (0, 0), (LENGTH, DEPTH), .14, .02, "walnut",
             near + far + [("left", 3.15, 4.85), ("right", 2.9, 5.1)])
    m.group("niches")
    for x in (BAY_X[0], BAY_X[4]):
        m.void((x - .45, .95, DEPTH), (x + .45, 2.55, DEPTH + .40), "plaster")
        m.solid((x - .55, .87, DEPTH - .08), (x + .55, .95, DEPTH), "stone")
        turned(m, x, .95, DEPTH + .18, .21, .80, BUST, "marble")
    m.group("pictures")
    land = [(0, 1, 0, .38, "book_green"), (0, .6, .38, .5, "book_ochre"), (.6, 1, .38, .62, "glaze"),
            (0, .6, .5, 1, "paper"), (.6, 1, .62, 1, "paper")]
    tall = [(0, .45, 0, .55, "terracotta"), (.45, 1, 0, .3, "book_brown"), (.45, 1, .3, 1, "book_cream"),
            (0, .45, .55, 1, "book_blue")]
    for x, y, z, quarters, width, height, canvas in (
            (0, 1.85, 1.35, 1, 1.0, 1.35, tall), (0, 1.85, 6.65, 1, 1.0, 1.35, tall),
            (LENGTH, 1.85, 1.35, 3, 1.5, 1.1, land), (LENGTH, 1.85, 6.65, 3, 1.5, 1.1, land)):
        picture(Frame(m, x, y, z, quarters), width, height, "brass", canvas, .07, .05)


def door(m):
    m.group("door")
    m.void((-.14, 0, 3.3), (0, 2.6, 4.7), "walnut", bottom="floor")
    casing(Frame(m, 0, 0, 4, 1), 1.4, 2.6, .15, .05, "walnut")
    m.solid((0, 2.75, 3.05), (.12, 2.85, 4.95), "walnut")
    m.solid((-.14, 0, 3.985), (-.10, 2.6, 4.015), "walnut")
    for z in (3.38, 4.09):
        for y0, y1 in ((.20, .95), (1.12, 1.80), (1.92, 2.48)):
            m.solid((-.14, y0, z), (-.115, y1, z + .53), "oak")
    for z in (3.935, 4.04):
        m.solid((-.14, 1.02, z), (-.08, 1.05, z + .025), "brass")


def hearth(m):
    m.group("hearth")
    front = LENGTH - BEAM
    m.solid((front, 0, 2.9), (LENGTH, HEIGHT, 5.1), "plaster")
    m.void((front, .03, 3.45), (LENGTH + .25, 1.0, 4.55), "soot")
    m.solid((front - .10, 0, 3.15), (front, 1.0, 3.45), "marble")
    m.solid((front - .10, 0, 4.55), (front, 1.0, 4.85), "marble")
    m.solid((front - .10, 1.0, 3.15), (front, 1.22, 4.85), "marble")
    m.solid((front - .20, 1.22, 3.05), (front, 1.29, 4.95), "marble")
    m.solid((front - .65, 0, 3.15), (front - .10, .03, 4.85), "stone")
    m.solid((front - .10, 0, 3.45), (front, .03, 4.55), "stone")
    m.solid((front + .08, .03, 3.65), (LENGTH + .12, .10, 4.35), "soot", top="embers")
    for x, z0, z1 in ((front + .13, 3.75, 4.20), (front + .24, 3.82, 4.28)):
        m.solid((x, .10, z0), (x + .08, .18, z1), "book_brown")
    for y, z in ((1.29, 3.3), (1.29, 4.7)):
        turned(m, front - .10, y, z, .075, .30, AMPHORA, "glaze", 8)
    m.group("clock")
    m.solid((front - .15, 1.29, 3.86), (front - .05, 1.33, 4.14), "walnut")
    m.solid((front - .14, 1.33, 3.89), (front - .06, 1.55, 4.11), "walnut", left="paper")
    m.group("seascape")
    picture(Frame(m, front, 2.35, 4, 3), 1.3, 1.4, "brass", [(0, 1, 0, .33, "sea"), (0, 1, .33, 1, "book_cream")], .08, .05)


def bookcase(m, x, choose):
    """Built against the wall z = DEPTH: cupboards below, ten compartments of books above, a cornice."""
    m.group("bookcases")
    depth, half, front = .36, .95, DEPTH - .36
    m.solid((x - half, 0, front), (x + half, 2.90, DEPTH), "walnut")
    m.solid((x - half - .05, 2.90, front - .05), (x + half + .05, 3.0, DEPTH), "walnut")
    for k in range(4):
        a = x - half + .05 + k * .455
        m.solid((a, .12, front - .02), (a + .435, .70, front), "oak")
        knob = a + (.395 if k % 2 == 0 else .02)
        m.solid((knob, .44, front - .04), (knob + .02, .46, front - .02), "brass")
    colours = ["book_red", "book_brown", "book_green", "book_blue", "book_ochre", "book_cream", "book_black", "book_plum"]
    for side in (0, 1):
        x0 = x - half + .04 + side * .93
        for row in range(5):
            y = .80 + .41 * row
            m.group("bookcases")
            m.void((x0, y, front), (x0 + .89, y + .38, DEPTH - .02), "walnut")
            m.group("books")
            width = .89 if choose(4) else .50 + .03 * choose(10)
            books(Frame(m, x0 + .89, y, DEPTH - .02, 2), width, depth - .05, .33, choose, colours)


def reading_table(m, choose):
    m.group("carpet")
    x, z, top = 6.0, 4.0, .012
    m.solid((x - 2.8, 0, z - 1.6), (x + 2.8, top, z + 1.6), "carpet", top="omit")
    rings = [(2.8, 1.6, "carpet_border"), (2.5, 1.3, "carpet_stripe"), (2.44, 1.24, "carpet")]
    for (a, b, material), inner in zip(rings, rings[1:] + [None]):
        if inner is None:
            m.rect(1, 1, top, (z - b, z + b), (x - a, x + a), material)
            continue
        c, d = inner[:2]
        m.rect(1, 1, top, (z - b, z - d), (x - a, x + a), material)
        m.rect(1, 1, top, (z + d, z + b), (x - a, x + a), material)
        m.rect(1, 1, top, (z - d, z + d), (x - a, x - c), material)
        m.rect(1, 1, top, (z - d, z + d), (x + c, x + a), material)
    m.group("table")
    f = Frame(m, x, top, z)
    f.solid((-1.8, .72, -.55), (1.8, .76, .55), "walnut", top="omit")
    m.rect(1, 1, top + .76, (z - .55, z + .55), (x - 1.8, x - 1.7), "walnut")
    m.rect(1, 1, top + .76, (z - .55, z + .55), (x + 1.7, x + 1.8), "walnut")
    m.rect(1, 1, top + .76, (z - .55, z - .45), (x - 1.7, x + 1.7), "walnut")
    m.rect(1, 1, top + .76, (z + .45, z + .55), (x - 1.7, x + 1.7), "walnut")
    m.rect(1, 1, top + .76, (z - .45, z + .45), (x - 1.7, x + 1.7), "leather")
    for s in (-1.3, 1.3):
        f.solid((s - .08, 0, -.42), (s + .08, .08, .42), "walnut")
        f.solid((s - .05, .08, -.28), (s + .05, .64, .28), "walnut")
        f.solid((s - .08, .64, -.45), (s + .08, .72, .45), "walnut")
    f.solid((-1.25, .26, -.03), (1.25, .38, .03), "walnut")
    m.group("chairs")
    for dx, pulled in ((-1.1, .80), (0, .84), (1.1, .80)):
        chair(f.frame(dx, 0, -pulled, 0), "walnut", "leather")
    for dx, pulled in ((-1.1, .82), (0, .80), (1.1, 1.02)):
        chair(f.frame(dx, 0, pulled, 2), "walnut", "leather")
    chair(f.frame(-2.06, 0, 0, 1), "walnut", "leather")
    chair(f.frame(2.08, 0, 0, 3), "walnut", "leather")
    m.group("table_lamps")
    y = top + .76
    for dx in (-.95, .95):
        lamp(m, x + dx, y, z, .34, (.15, .10, .16), "brass", "lamp_shade")
    m.group("on_the_table")
    f = Frame(m, x, y, z)
    f.solid((-.22, 0, .10), (.22, .012, .40), "book_red")  # an open book
    f.solid((-.21, .012, .11), (-.005, .03, .39), "paper")
    f.solid((.005, .012, .11), (.21, .03, .39), "paper")
    height = 0.0
    for width, depth, thick, material in ((.30, .22, .05, "book_brown"), (.27, .20, .04, "book_green"),
                                          (.24, .18, .035, "book_ochre")):
        f.solid((-.45 - width / 2, height, -.30), (-.45 + width / 2, height + thick, -.30 + depth), material)
        height += thick
    f.solid((.40, 0, -.32), (.61, .004, -.02), "paper")
    f.solid((1.25, 0, .08), (1.46, .004, .38), "paper")
    f.solid((-1.52, 0, -.36), (-1.30, .06, -.06), "book_blue")


def things(m):
    m.group("globe")
    x, z = BAY_X[1] - .1, 1.05
    m.solid((x - .24, 0, z - .24), (x + .24, .06, z + .24), "walnut", top="omit")
    m.square_around_circle(x, .06, z, .24, .10, True, "walnut")
    low, bands = sphere_bands(.36, 0, .05, "sea", 2, 8)
    stem = [(.05, .14, "walnut", 1), (.045, .40, "walnut", 1), (.08, .46, "walnut", 1), (.05, .56, "brass", 0)]
    m.lathe(x, z, (.10, .06), stem + [(r, h + .56 - low, material, s) for r, h, material, s in bands])
    m.group("pedestals")
    for x, shape in ((BAY_X[0], AMPHORA), (BAY_X[4], URN)):
        z = .48
        m.solid((x - .26, 0, z - .26), (x + .26, .12, z + .26), "marble")
        m.solid((x - .20, .12, z - .20), (x + .20, .98, z + .20), "marble")
        m.solid((x - .25, .98, z - .25), (x + .25, 1.06, z + .25), "marble")
        turned(m, x, 1.06, z, .22, .72, shape, "terracotta")
    m.group("armchairs")
    for f in (Frame(m, 10.75, 0, 2.15, 0), Frame(m, 10.75, 0, 5.85, 2)):
        sofa(f, .95, "leather", "walnut", 1)
    m.group("floor_lamp")
    lamp(m, 11.55, 0, 2.35, 1.45, (.22, .15, .26), "brass", "lamp_shade", 16)
    m.group("steps")
    for k in range(3):
        m.solid((7.45, 0, 7.0 + .18 * k), (7.95, .22 * (k + 1), 7.18 + .18 * k), "oak")
    m.group("side_table")
    f = Frame(m, 11.55, 0, 5.75)
    f.solid((-.22, 0, -.22), (.22, .03, .22), "walnut")
    f.solid((-.04, .03, -.04), (.04, .52, .04), "walnut")
    f.solid((-.25, .52, -.25), (.25, .56, .25), "walnut")
    f.solid((-.14, .56, -.10), (.08, .60, .12), "book_plum")
