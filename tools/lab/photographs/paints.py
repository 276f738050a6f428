"""The surfaces of the desk: functions from meters on a surface to linear colors.

Every paint takes u and v, arrays in meters, and a seed, which distinguishes two surfaces of one
kind; it returns an array of the same length with three columns.
"""

import numpy as np


def linear(*srgb):
    """Converts an sRGB color, in levels of 255, to linear light."""
    return (np.array(srgb) / 255.0) ** 2.2


# ---- noise ---------------------------------------------------------------------------------------

def hashed(i, j, seed):
    """A number from 0 to 1 for each pair of integers, the same on every machine."""
    h = (i.astype(np.int64) * 374761393 + j.astype(np.int64) * 668265263 + seed * 1274126177)
    h = h.astype(np.uint32)
    h ^= h >> np.uint32(15)
    h *= np.uint32(2246822519)
    h ^= h >> np.uint32(13)
    h *= np.uint32(3266489917)
    h ^= h >> np.uint32(16)
    return h / 4294967295.0


def noise(u, v, seed):
    """Smooth noise from 0 to 1 with a wavelength of about one."""
    i, j = np.floor(u), np.floor(v)
    s, t = u - i, v - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    low = hashed(i, j, seed) * (1 - s) + hashed(i + 1, j, seed) * s
    high = hashed(i, j + 1, seed) * (1 - s) + hashed(i + 1, j + 1, seed) * s
    return low * (1 - t) + high * t


def clouds(u, v, seed, octaves):
    """Noise of several wavelengths; each has half the wavelength and amplitude of the previous."""
    total, weight = np.zeros_like(u), 0.0
    for octave in range(octaves):
        scale = 2.0 ** octave
        total += noise(u * scale, v * scale, seed + 31 * octave) / scale
        weight += 1 / scale
    return total / weight


# ---- shapes --------------------------------------------------------------------------------------

def step(low, high, x):
    """0 below low, 1 above high, smooth in between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, share):
    return a + (b - a) * np.asarray(share)[:, None]


def within(u, v, box):
    """Whether positions are within (u0, v0, u1, v1)."""
    return ((u > box[0]) & (v > box[1]) & (u < box[2]) & (v < box[3])).astype(float)


def letters(u, v, box, lines, seed):
    """Lines of blocks that look like print from a distance: 1 for ink."""
    height = (box[3] - box[1]) / lines
    row = np.floor((v - box[1]) / height)
    column = np.floor((u - box[0]) / (height * 0.45))
    inside_u = (u - box[0]) / (height * 0.45) - column
    inside_v = (v - box[1]) / height - row
    word = hashed(column, row, seed) > 0.2
    end = box[0] + (box[2] - box[0]) * (0.55 + 0.45 * hashed(row, row, seed + 1))
    # A letter is a block of 3 x 5 strokes; some have no ink.
    stroke = hashed(column * 3 + np.floor(inside_u * 3.6), row * 5 + np.floor(inside_v * 7),
                    seed + 2) > 0.33
    body = (inside_u < 0.83) & (inside_v > 0.2) & (inside_v < 0.86)
    return within(u, v, box) * (word & stroke & body & (u < end))


# ---- walls and floor -----------------------------------------------------------------------------

def brick(u, v, seed):
    length, height, joint = 0.225, 0.075, 0.006
    wu = u + 0.004 * (clouds(u * 60, v * 60, seed, 2) - 0.5)
    wv = v + 0.004 * (clouds(u * 50, v * 50, seed + 1, 2) - 0.5)
    row = np.floor(wv / height)
    shifted = wu / length + 0.5 * (row % 2) + 0.06 * (hashed(row, row, seed) - 0.5)
    column = np.floor(shifted)
    inside_u, inside_v = (shifted - column) * length, wv - row * height
    edge = np.minimum(np.minimum(inside_u, length - inside_u),
                      np.minimum(inside_v, height - inside_v))
    tone, kind = hashed(column, row, seed + 2), hashed(column, row, seed + 3)
    color = mix(linear(138, 88, 72), linear(164, 112, 92), tone)
    color = mix(color, linear(108, 78, 72), 0.85 * (kind > 0.84))
    color = mix(color, linear(176, 140, 116), 0.6 * (kind < 0.1))
    color = color * (0.72 + 0.56 * clouds(u * 26, v * 40, seed + 4, 4))[:, None]
    pits = step(0.62, 0.76, clouds(u * 110, v * 140, seed + 5, 3))
    color = color * (1 - 0.4 * pits)[:, None]
    bloom = step(0.55, 0.8, clouds(u * 5, v * 7, seed + 6, 3))
    color = mix(color, linear(190, 170, 155), 0.35 * bloom)
    mortar = mix(linear(150, 142, 130), linear(186, 178, 164),
                 clouds(u * 110, v * 110, seed + 7, 3))
    # The joint is recessed: the brick above shades its upper side.
    shade = np.where(inside_v > height - joint, 0.74, 1.0)
    face = step(joint - 0.002, joint + 0.001, edge)
    rounded = 0.82 + 0.18 * step(joint, joint + 0.006, edge)
    return mix(mortar * shade[:, None], color * rounded[:, None], face)


def plaster(u, v, seed):
    """Lime plaster under thin paint, with repaired patches and scuffs."""
    color = mix(linear(176, 178, 160), linear(205, 203, 184), clouds(u * 3, v * 3, seed, 5))
    grain = clouds(u * 90, v * 90, seed + 1, 2)
    color = color * (0.86 + 0.28 * grain)[:, None]
    trowel = clouds(u * 9 + v * 4, v * 40 - u * 12, seed + 2, 3)
    color = color * (0.93 + 0.14 * trowel)[:, None]
    mended = step(0.6, 0.64, clouds(u * 4.5, v * 4.5, seed + 3, 3))
    color = mix(color, linear(196, 186, 168), 0.55 * mended)
    specks = step(0.66, 0.76, clouds(u * 45, v * 60, seed + 4, 4))
    scratch = step(0.93, 0.97, 1 - np.abs(2 * clouds(u * 6, v * 11, seed + 5, 4) - 1))
    scratch = scratch * step(0.55, 0.7, clouds(u * 4, v * 4, seed + 6, 2))
    return color * (1 - 0.25 * specks)[:, None] * (1 - 0.35 * scratch)[:, None]


def tiles(u, v, seed):
    size, joint = 0.2, 0.004
    column, row = np.floor(u / size), np.floor(v / size)
    inside_u, inside_v = u - column * size, v - row * size
    edge = np.minimum(np.minimum(inside_u, size - inside_u),
                      np.minimum(inside_v, size - inside_v))
    color = mix(linear(120, 108, 96), linear(146, 128, 110), hashed(column, row, seed))
    color = color * (0.7 + 0.6 * clouds(u * 14, v * 14, seed + 1, 4))[:, None]
    flecks = step(0.6, 0.74, clouds(u * 70, v * 70, seed + 2, 3))
    color = mix(color, linear(90, 82, 76), 0.5 * flecks)
    grout = linear(88, 84, 80) * (0.8 + 0.4 * noise(u * 150, v * 150, seed + 3))[:, None]
    return mix(grout, color, step(joint - 0.001, joint + 0.002, edge))


# ---- wood ----------------------------------------------------------------------------------------

def wood(u, v, seed, plank=0.115):
    """Planks along u."""
    row = np.floor(v / plank)
    inside = v - row * plank
    shift = 7.3 * hashed(row, row, seed)
    lu = u + shift
    lv = inside + 0.4 * hashed(row, row, seed + 1)
    bend = clouds(lu * 1.6, lv * 9, seed + 2, 3) - 0.5
    knot_u, knot_v = 0.9 * hashed(row, row, seed + 8) - 0.2, plank * (
        0.25 + 0.5 * hashed(row, row, seed + 9))
    knot = np.exp(-(((u - knot_u) / 0.035) ** 2 + ((inside - knot_v) / 0.014) ** 2))
    rings = (lv + 0.035 * bend) * 165 + 5.5 * knot
    ring = (0.5 + 0.5 * np.sin(2 * np.pi * rings * 0.75)) ** 2
    streaks = clouds(lu * 9, lv * 330, seed + 3, 3)
    tone = hashed(row, row, seed + 4)
    color = mix(linear(158, 112, 70), linear(186, 142, 94), tone)
    color = mix(color, linear(116, 74, 42), 0.5 * ring * (0.5 + 0.5 * noise(lu * 3, lv * 20, seed)))
    color = color * (0.7 + 0.6 * streaks)[:, None]
    color = color * (1 - 0.62 * knot)[:, None]
    pores = step(0.74, 0.84, noise(lu * 38, lv * 420, seed + 5))
    color = color * (1 - 0.4 * pores)[:, None]
    stain = step(0.55, 0.75, clouds(u * 5, v * 5, seed + 6, 3))
    color = color * (1 - 0.18 * stain)[:, None]
    gap = step(0.0006, 0.0022, np.minimum(inside, plank - inside))
    return color * (0.25 + 0.75 * gap)[:, None]


def leg(u, v, seed):
    """Wood with its grain along v."""
    return wood(v, u, seed, plank=0.2)


# ---- cardboard -----------------------------------------------------------------------------------

def cardboard(u, v, seed):
    color = mix(linear(158, 124, 88), linear(180, 148, 108), clouds(u * 12, v * 12, seed, 4))
    fibres = clouds(u * 140, v * 40, seed + 1, 2)
    flutes = 0.5 + 0.5 * np.sin(2 * np.pi * u / 0.008)
    color = color * (0.88 + 0.2 * fibres + 0.05 * flutes)[:, None]
    flecks = step(0.78, 0.86, noise(u * 160, v * 110, seed + 2))
    return color * (1 - 0.35 * flecks)[:, None]


def carton_top(u, v, seed):
    """Two flaps under a strip of tape along the middle, at v = 0.12."""
    color = cardboard(u, v, seed)
    color = color * (1 - 0.75 * (np.abs(v - 0.12) < 0.0015))[:, None]
    torn = 0.027 + 0.002 * noise(u * 120, v * 0, seed + 3)
    tape = 0.75 * (np.abs(v - 0.12) < torn)
    color = mix(color, linear(172, 138, 80) * (0.86 + 0.28 * noise(
        u * 60, v * 200, seed + 4))[:, None], tape)
    return mix(color, linear(60, 48, 40), 0.8 * letters(u, v, (0.03, 0.02, 0.16, 0.07), 2, seed))


def carton_front(u, v, seed):
    """A paper label with print and bars, and a printed sign beside it."""
    color = cardboard(u, v, seed)
    label = within(u, v, (0.035, 0.045, 0.195, 0.165))
    paper = linear(226, 222, 210) * (0.93 + 0.1 * clouds(u * 30, v * 30, seed + 5, 3))[:, None]
    color = mix(color, paper, label)
    color = mix(color, linear(158, 52, 44), within(u, v, (0.035, 0.138, 0.195, 0.165)))
    color = mix(color, linear(232, 226, 214),
                letters(0.23 - u, 0.3 - v, (0.045, 0.139, 0.185, 0.158), 1, seed + 9))
    ink = letters(u, v, (0.045, 0.088, 0.185, 0.133), 4, seed + 6)
    bars = hashed(np.floor(u / 0.0022), np.zeros_like(u), seed + 7) > 0.5
    ink = np.maximum(ink, bars * within(u, v, (0.045, 0.053, 0.125, 0.081)))
    ink = np.maximum(ink, letters(u, v, (0.135, 0.053, 0.188, 0.081), 3, seed + 8))
    color = mix(color, linear(44, 42, 46), 0.9 * ink)
    frame = within(u, v, (0.235, 0.05, 0.305, 0.16)) - within(u, v, (0.239, 0.054, 0.301, 0.156))
    shaft = within(u, v, (0.262, 0.064, 0.278, 0.115))
    tip = (v > 0.11) & (np.abs(u - 0.27) < (0.145 - v) * 0.7)
    worn = 0.85 * step(0.25, 0.4, noise(u * 120, v * 120, seed + 10))
    return mix(color, linear(52, 42, 38), worn * np.maximum(frame, np.maximum(shaft, tip)))


# ---- books and paper -----------------------------------------------------------------------------

def cover(u, v, seed, size, cloth, print_color):
    """Cloth with a frame, a title and a worn border."""
    weave = 0.5 * noise(u * 240, v * 120, seed) + 0.5 * noise(u * 120, v * 240, seed + 1)
    color = cloth * (0.74 + 0.32 * weave + 0.2 * clouds(u * 15, v * 15, seed + 2, 3))[:, None]
    edge = np.minimum(np.minimum(u, size[0] - u), np.minimum(v, size[1] - v))
    frame = (edge > 0.012) & (edge < 0.0155)
    title = letters(u, v, (0.16 * size[0], 0.55 * size[1], 0.86 * size[0], 0.8 * size[1]), 2,
                    seed + 3)
    name = letters(u, v, (0.16 * size[0], 0.2 * size[1], 0.6 * size[0], 0.3 * size[1]), 1, seed + 4)
    middle = np.hypot(u - 0.68 * size[0], v - 0.32 * size[1])
    star = (middle < 0.022) & (np.abs(((middle * 190) % 1) - 0.5) < 0.28)
    ink = np.maximum(np.maximum(frame, star), np.maximum(title, name))
    color = mix(color, print_color, 0.85 * ink * step(0.2, 0.4, noise(u * 150, v * 150, seed + 5)))
    worn = step(0.004, 0.0, edge - 0.004 * noise(u * 90, v * 90, seed + 6))
    return mix(color, linear(178, 164, 140), 0.45 * worn)


def spine(u, v, seed, size, cloth, print_color):
    """The spine of a book, with bands across it and a title along it."""
    weave = 0.5 * noise(u * 240, v * 120, seed) + 0.5 * noise(u * 120, v * 240, seed + 1)
    color = cloth * (0.7 + 0.5 * weave)[:, None]
    from_end = np.minimum(u, size[0] - u)
    bands = ((from_end > 0.018) & (from_end < 0.022)) | ((from_end > 0.027) & (from_end < 0.029))
    title = letters(u, v, (0.25 * size[0], 0.25 * size[1], 0.8 * size[0], 0.8 * size[1]), 1,
                    seed + 3)
    return mix(color, print_color, 0.85 * np.maximum(bands, title))


def pages(u, v, seed, size, cloth):
    """The page edges of a book between its covers."""
    sheets = noise(u * 7, v * 900, seed) * 0.6 + noise(u * 25, v * 450, seed + 1) * 0.4
    color = linear(206, 194, 166) * (0.66 + 0.42 * sheets)[:, None]
    color = color * (0.88 + 0.2 * clouds(u * 25, v * 40, seed + 2, 2))[:, None]
    board = (v < 0.0025) | (v > size[1] - 0.0025)
    return mix(color, cloth * 0.9, board)


def squared_paper(u, v, seed):
    """Squares of 5 mm, a margin, and lines of writing."""
    color = linear(222, 220, 210) * (0.94 + 0.08 * clouds(u * 20, v * 20, seed, 3))[:, None]
    to_line = np.minimum(np.abs((u / 0.005 + 0.5) % 1 - 0.5), np.abs((v / 0.005 + 0.5) % 1 - 0.5))
    color = mix(color, linear(128, 156, 186), 0.6 * step(0.16, 0.06, to_line))
    color = mix(color, linear(190, 84, 80), 0.8 * (np.abs(u - 0.03) < 0.0007))
    row = np.floor(v / 0.015)
    middle = v - (row + 0.45) * 0.015
    wave = 0.0035 * np.sin(2 * np.pi * (u * 150 + 2.2 * noise(u * 70, row, seed + 1)))
    wave = wave * (0.3 + noise(u * 45, row + 9, seed + 2))
    word = noise(u * 33, row * 3, seed + 3) > 0.3
    end = 0.19 - 0.09 * hashed(row, row, seed + 4) ** 3
    written = within(u, v, (0.036, 0.06, end, 0.27)) * (hashed(row, row, seed + 5) > 0.15)
    ink = (np.abs(middle - wave) < 0.0011) & word & (written > 0)
    return mix(color, linear(44, 52, 98), 0.85 * ink)


# ---- paint and prints ----------------------------------------------------------------------------

def tin(u, v, seed):
    """The side of a painted tin: bands, diamonds, dents in the paint."""
    color = mix(linear(58, 104, 104), linear(72, 122, 116), clouds(u * 20, v * 20, seed, 3))
    cream = linear(214, 202, 168) * (0.9 + 0.15 * noise(u * 60, v * 60, seed + 1))[:, None]
    color = mix(color, cream, (v > 0.035) & (v < 0.1))
    column = u / 0.02618
    from_middle = np.abs(column - np.floor(column) - 0.5) / 0.5 + np.abs(v - 0.0675) / 0.026
    tone = hashed(np.floor(column), np.zeros_like(u), seed + 2)[:, None]
    color = np.where((from_middle < 0.92)[:, None],
                     np.where(tone > 0.5, linear(166, 74, 52), linear(196, 146, 62)), color)
    color = np.where((from_middle < 0.4)[:, None], cream, color)
    bands = (np.abs(v - 0.041) < 0.0015) | (np.abs(v - 0.094) < 0.0015)
    color = mix(color, linear(150, 64, 48), bands)
    chips = step(0.74, 0.77, clouds(u * 45, v * 45, seed + 3, 3))
    color = mix(color, linear(120, 112, 104), 0.8 * chips)
    return color * (0.9 + 0.2 * clouds(u * 35, v * 35, seed + 4, 3))[:, None]


def lid(u, v, seed):
    color = linear(64, 108, 106) * (0.8 + 0.4 * clouds(u * 50, v * 50, seed, 3))[:, None]
    radius = np.hypot(u - 0.05, v - 0.05)
    color = color * (1 - 0.5 * (np.abs(radius - 0.042) < 0.0012))[:, None]
    return mix(color, linear(206, 194, 160), (radius > 0.022) & (radius < 0.026))


def picture(u, v, seed):
    """A framed print of hills by a lake, 0.46 wide and 0.34 high."""
    share = np.clip(v / 0.34, 0, 1)
    color = mix(linear(216, 196, 160), linear(124, 150, 172), step(0.45, 1.0, share))
    cloud = step(0.5, 0.7, clouds(u * 9, v * 24, seed, 4))
    color = mix(color, linear(226, 220, 206), 0.7 * cloud)
    sun = np.hypot(u - 0.33, v - 0.245)
    color = mix(color, linear(232, 190, 110), step(0.026, 0.023, sun))
    for depth, (height, tint) in enumerate(((0.2, (128, 142, 146)), (0.165, (98, 120, 104)),
                                            (0.13, (70, 92, 66)))):
        ridge = height + 0.085 * (clouds(u * (6 + 4 * depth), u * 0, seed + depth, 5) - 0.5)
        below = step(ridge + 0.001, ridge - 0.001, v)
        tinted = linear(*tint) * (0.72 + 0.56 * clouds(u * 50, v * 70, seed + 7, 3))[:, None]
        color = mix(color, tinted, below)
    water = mix(linear(84, 112, 128), linear(150, 168, 170), clouds(u * 14, v * 160, seed + 8, 3))
    color = mix(color, water, step(0.092, 0.09, v + 0.006 * noise(u * 25, u * 0, seed + 9)))
    edge = np.minimum(np.minimum(u, 0.46 - u), np.minimum(v, 0.34 - v))
    mount = linear(218, 212, 198) * (0.92 + 0.12 * noise(u * 90, v * 90, seed + 10))[:, None]
    color = mix(mount, color, step(0.046, 0.047, edge))
    return mix(0.5 * wood(u, v, seed + 11, plank=0.5), color, step(0.018, 0.019, edge))
