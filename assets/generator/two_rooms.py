"""Two rooms and a door between them: the lamp is in one room only."""
from .furniture import Chooser, Frame, books, casing, chair, picture, skirting, sofa, sphere_bands, table
from .model import Model
from .small_scenes import LICENCE


def two_rooms():
    m = Model("two_rooms", [
        "Two rooms joined by a doorway. Unit: m, y up. E and B in W/m^2. Closed on all sides.",
        "Teaches: light that has to be reflected to arrive. The lamp is in the first room (x < 4.0); the second (x > 4.2) is",
        "lit only through the door, by one slanting beam and by what the first room reflects: its orange wall reddens the",
        "second room. A solver that stops after the direct light leaves half of the second room black.",
        "Look: --eye 7.6,1.6,0.9 --at 4.2,1.1,1.9 --fov 60     the dark room, its door, the lit room behind",
        "Look: --eye 3.6,1.6,3.2 --at 0.9,1.0,0.9 --fov 72     the lit room",
        "Look: --eye 4.6,1.6,0.6 --at 7.6,0.9,2.6 --fov 72     the dark room from its door",
        "Source: our own. " + LICENCE])
    wall = m.material("wall", (.75, .73, .69))
    orange = m.material("orange_wall", (.76, .26, .07))
    ceiling = m.material("ceiling", (.82, .82, .81))
    oak = m.material("oak_floor", (.46, .34, .22))
    trim = m.material("white_trim", (.80, .79, .76))
    wood = m.material("beech", (.58, .42, .27))
    dark = m.material("walnut", (.24, .15, .09))
    cloth = m.material("blue_cloth", (.16, .28, .47))
    cushion = m.material("cream_cloth", (.78, .72, .58))
    plaster = m.material("plaster", (.83, .82, .80))
    green = m.material("green_leaf", (.13, .35, .12))
    clay = m.material("clay", (.55, .25, .15))
    brass = m.material("brass", (.62, .48, .22))
    rug = m.material("rug", (.62, .56, .46))
    lamp = m.material("lamp", (.80, .80, .80), (30, 25, 18), "a plate of frosted glass, 0.36 m^2")

    depth, height = 3.6, 2.6
    door = (1.30, 2.30, 2.10)  # z from, z to, height
    door_z = (door[0] + door[1]) / 2

    m.group("room_lit")
    m.void((0, 0, 0), (4, height, depth), wall, bottom=oak, top=ceiling, left=orange)
    m.group("room_dark")
    m.void((4.2, 0, 0), (8, height, depth), wall, bottom=oak, top=ceiling)
    m.group("doorway")
    m.void((4, 0, door[0]), (4.2, door[2], door[1]), trim, bottom=oak)
    for z in ((door[0], door[0] + .015), (door[1] - .015, door[1])):  # the stop that the leaf closes against
        m.solid((4.10, 0, z[0]), (4.14, door[2], z[1]), trim)
    m.solid((4.10, door[2] - .015, door[0] + .015), (4.14, door[2], door[1] - .015), trim)
    m.group("door_frame")
    casing(Frame(m, 4, 0, door_z, 3), 1.0, door[2], .08, .025, trim)
    casing(Frame(m, 4.2, 0, door_z, 1), 1.0, door[2], .08, .025, trim)
    m.group("door_leaf")  # stands open at a right angle, one centimetre above the floor
    m.solid((4.225, .01, 2.32), (5.205, 2.09, 2.36), trim)
    for z0, z1 in ((2.26, 2.32), (2.36, 2.42)):
        m.solid((5.12, 1.02, z0), (5.14, 1.04, z1), brass)
        towards = (z0 - .02, z0) if z0 < 2.3 else (z1, z1 + .02)
        m.solid((5.02, 1.02, towards[0]), (5.14, 1.04, towards[1]), brass)

    m.group("skirting")
    skirting(m, (0, 0), (4, depth), .08, .015, trim,
             [("right", door[0] - .08, door[1] + .08), ("far", .8, 2.4)])
    skirting(m, (4.2, 0), (8, depth), .08, .015, trim,
             [("left", door[0] - .08, door[1] + .08), ("near", 5.0, 6.9), ("far", 5.0, 6.4)])

    m.group("lamp")
    m.solid((.9, height - .06, .7), (1.5, height, 1.3), trim, bottom="omit")
    m.rect(1, -1, height - .06, (.7, 1.3), (.9, 1.5), lamp)

    m.group("table")
    table(Frame(m, 2.05, 0, 1.55), 1.4, .8, .75, wood)
    m.group("chairs")
    chair(Frame(m, 1.75, 0, 2.12, 2), wood, cloth)
    chair(Frame(m, 2.35, 0, .98, 0), wood, cloth)
    m.group("plant")
    m.solid((2.28, .75, 1.38), (2.42, .76, 1.52), clay, top="omit")
    m.square_around_circle(2.35, .76, 1.45, .07, .04, True, clay, 8)
    m.lathe(2.35, 1.45, (.04, .76), [(.07, .88, clay, 1), (.075, .90, clay, 1), (.06, .90, clay, 0), (.02, .92, green, 0),
                                     (.09, .98, green, 2), (.12, 1.06, green, 2), (.08, 1.15, green, 2),
                                     (0, 1.20, green, 2)], 8)
    m.group("bowl")
    m.solid((1.5, .75, 1.48), (1.74, .78, 1.72), plaster)

    m.group("sideboard")
    m.solid((.8, .08, 3.2), (2.4, .80, depth), dark)
    for x in (.84, 2.32):
        m.solid((x, 0, 3.24), (x + .04, .08, 3.28), dark)
        m.solid((x, 0, 3.52), (x + .04, .08, 3.56), dark)
    for k in range(3):
        x = .83 + .52 * k
        m.solid((x, .12, 3.185), (x + .50, .76, 3.2), dark)
        m.solid((x + .24, .60, 3.165), (x + .26, .64, 3.185), brass)
    m.group("books")
    x = .95
    for width, tall, thick, material in ((.04, .24, .17, orange), (.03, .21, .15, cloth), (.05, .26, .18, cushion),
                                         (.04, .22, .16, green), (.03, .24, .17, cloth)):
        m.solid((x, .80, depth - thick), (x + width, .80 + tall, depth), material)
        x += width
    m.group("picture_lit")
    picture(Frame(m, 1.75, 1.55, depth, 2), .9, .65, dark,
            [(0, .62, 0, .4, green), (0, .62, .4, 1, cloth), (.62, 1, 0, .4, clay), (.62, 1, .4, 1, cushion)])

    m.group("picture_near")
    picture(Frame(m, 2.3, 1.5, 0, 0), 1.3, .8, dark,
            [(0, 1, 0, .35, clay), (0, .5, .35, 1, cushion), (.5, 1, .35, .7, green), (.5, 1, .7, 1, plaster)])

    m.group("sofa")
    sofa(Frame(m, 5.95, 0, 0), 1.9, cloth, dark)
    m.solid((5.24, .48, .22), (5.64, .82, .34), cushion)
    m.group("shelf")
    m.solid((5.0, 0, 3.3), (6.4, 1.0, depth), wood)
    choose = Chooser(3)
    for k in range(2):
        for y in (.08, .53):
            x = 5.03 + .68 * k
            m.group("shelf")
            m.void((x, y, 3.3), (x + .66, y + .42, depth - .02), wood)
            m.group("shelf_books")
            books(Frame(m, x + .66, y, depth - .02, 2), .66 if choose(2) else .45, .26, .36, choose,
                  [orange, cloth, cushion, green, clay])
    m.group("rug")
    m.solid((5.3, 0, 1.15), (7.1, .012, 2.45), rug)
    m.group("low_table")
    table(Frame(m, 6.0, .012, 1.6), .9, .55, .40, wood, leg=.05, top=.03, apron=.05)
    m.group("sphere_on_plinth")
    m.solid((7.35, 0, 2.85), (7.75, .75, 3.25), plaster, top="omit")
    m.square_around_circle(7.55, .75, 3.05, .20, .09, True, plaster)
    low, bands = sphere_bands(.22, 0, .09, plaster, 3)
    bands = [(r, y + .75 - low, material, smoothing) for r, y, material, smoothing in bands]
    m.lathe(7.55, 3.05, (.09, .75), bands)
    m.group("picture_dark")
    picture(Frame(m, 8, 1.55, 1.5, 3), 1.1, .8, dark,
            [(0, .3, 0, .55, cushion), (0, .3, .55, 1, green), (.3, 1, 0, .3, orange), (.3, 1, .3, 1, plaster)])
    return m
