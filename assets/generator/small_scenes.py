"""The three small scenes: Cornell box, two patches, furnace."""
from math import atan, log, pi, sqrt

from .model import Model

LICENCE = "Licence: MIT, as the project."


def cornell_box():
    m = Model("cornell_box", [
        "Cornell box. Unit: mm, y up, open towards -z. E and B in W/m^2.",
        "Teaches: colour bleeding (red and green on the white blocks), soft shadows, and what an open front lets escape.",
        "Look: --eye 278,273,-800 --at 278,273,0 --fov 39.3077",
        "Source: our own modelling of the dimensions and colours that the Cornell Program of Computer Graphics published;",
        "those are facts. The light is set into a hole of the ceiling; the floor stops at the blocks that stand on it;",
        "the left wall, whose four published corners are not in a plane, is two planar polygons, smooth across their edge.",
        LICENCE])
    white = m.material("white", (.725, .71, .68))
    red = m.material("red", (.63, .065, .05))
    green = m.material("green", (.14, .45, .091))
    light = m.material("light", (.78, .78, .78), (17, 12, 4))

    height = 548.8
    short = [(130, 65), (82, 225), (240, 272), (290, 114)]
    tall = [(423, 247), (265, 296), (314, 456), (472, 406)]
    front_left, front_right, back_right, back_left = (552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)

    def on_floor(corners):
        return [(x, 0, z) for x, z in corners]

    def on_ceiling(*corners):
        return [(x, height, z) for x, z in corners]

    m.group("floor")  # two polygons, before and behind the blocks; each runs around its side of their footprints
    s, t = on_floor(short), on_floor(tall)
    m.polygon([front_left, front_right, s[0], s[3], s[2], t[1], t[0], t[3], back_left], white)
    m.polygon([front_right, back_right, back_left, t[3], t[2], t[1], s[2], s[1], s[0]], white)

    m.group("ceiling")
    xs, zs = (0, 213, 343, 556), (0, 227, 332, 559.2)
    for i in range(3):
        for j in range(3):
            corners = on_ceiling((xs[i + 1], zs[j]), (xs[i + 1], zs[j + 1]), (xs[i], zs[j + 1]), (xs[i], zs[j]))
            if (i, j) != (1, 1):
                m.polygon(corners, white)
    m.group("light")
    m.polygon(on_ceiling((343, 227), (343, 332), (213, 332), (213, 227)), light)

    m.group("back_wall")
    m.polygon([back_left, back_right] + on_ceiling((0, 559.2), (213, 559.2), (343, 559.2), (556, 559.2)), white)
    m.group("right_wall")
    m.polygon([back_right, front_right] + on_ceiling((0, 0), (0, 227), (0, 332), (0, 559.2)), green)
    m.group("left_wall")
    m.polygon([front_left, back_left] + on_ceiling((556, 0)), red, 1)
    m.polygon([back_left] + on_ceiling((556, 559.2), (556, 332), (556, 227), (556, 0)), red, 1)

    for name, corners, top in (("short_block", short, 165), ("tall_block", tall, 330)):
        m.group(name)
        m.polygon([(x, top, z) for x, z in corners], white)
        for (x0, z0), (x1, z1) in zip(corners, corners[1:] + corners[:1]):
            m.polygon([(x0, 0, z0), (x1, 0, z1), (x1, top, z1), (x0, top, z0)], white)
    return m


def form_factor_parallel(x, y, xi, eta, z):
    """F from rectangle x[0..1] x y[0..1] to rectangle xi[0..1] x eta[0..1], parallel at distance z, edges aligned."""
    def g(u, v):
        a, b = sqrt(u * u + z * z), sqrt(v * v + z * z)
        return (v * a * atan(v / a) + u * b * atan(u / b) - z * z / 2 * log(u * u + v * v + z * z)) / (2 * pi)
    total = sum((-1) ** (i + j + k + n) * g(x[i] - xi[n], y[j] - eta[k])
                for i in range(2) for j in range(2) for k in range(2) for n in range(2))
    return total / ((x[1] - x[0]) * (y[1] - y[0]))


def two_patches():
    floor_x, floor_z, light_x, light_z, height = (0, 4), (0, 3), (1, 3), (1, 2), 1.8
    f12 = form_factor_parallel(light_x, light_z, floor_x, floor_z, height)
    f21 = f12 * 2 / 12
    rho1, rho2, emission = .5, .6, 10
    b1 = emission / (1 - rho1 * rho2 * f12 * f21)
    m = Model("two_patches", [
        "Two patches: a light in the ceiling over a floor, the first example of every lecture on radiosity.",
        "Unit: m, y up. E and B in W/m^2.",
        "Teaches: light that goes back and forth between two patches and grows less with each reflection.",
        "Look: --eye 4.6,1.1,5.5 --at 2,0.75,1.5 --fov 50",
        f"Light 1: 2 x 1 m, {height} m above floor 2: 4 x 3 m; only their inner sides count (--emit front).",
        f"Exact form factors F12 = {f12:.9f}, F21 = F12 A1/A2 = {f21:.9f}. With E1 = {emission}, rho1 = {rho1} and rho2 = {rho2}",
        "(red channel), and one radiosity for each patch, B1 = E1/(1 - rho1 rho2 F12 F21), B2 = rho2 F21 B1:",
        f"B1 = {b1:.6f}, B2 = {rho2 * f21 * b1:.6f}. A finer mesh finds the pool of light; its mean stays near B2.",
        "Source: our own. " + LICENCE])
    light = m.material("light", (rho1,) * 3, (emission, 9.6, 8.8))
    floor = m.material("floor", (rho2, .48, .36))
    m.group("light")
    m.rect(1, -1, height, light_z, light_x, light)
    m.group("floor")
    m.rect(1, 1, 0, floor_z, floor_x, floor)
    return m


def furnace():
    m = Model("furnace", [
        "Furnace: a closed cube with reflectance 0.5 and emission 0.5 on every inner side. Unit: m, y up. E and B in W/m^2.",
        "Teaches: closure. Seen from any point the form factors add up to 1, so B = E/(1 - rho) = 1 exactly, everywhere:",
        "a picture that is not of one even grey shows the error of the form factors and nothing else. After k bounces",
        "B = 1 - 0.5^(k+1): the plot of error against bounces must be a straight line that halves at each.",
        "Look: --eye 0.3,1.6,1.8 --at 1.2,0.8,0.6 --fov 75",
        "Source: our own. " + LICENCE])
    glow = m.material("glow", (.5, .5, .5), (.5, .5, .5))
    m.void((0, 0, 0), (2, 2, 2), glow)
    return m
