"""Draws the figures of docs/paper.md as SVG: facets of a triangulation, and logarithmic plots.

A Delaunay triangulation has no cycles in depth from any place: along a direction its cells are in
the order of the centers of their spheres (Edelsbrunner, "An acyclicity theorem for cell complexes
in d dimensions", Combinatorica 10, 1990). So painting facets in the order of the cells behind them
hides exactly what is hidden.
"""
import math

PANEL_PX = 300
LINE_PX = 16
MARGIN_PX = 14
FINE = 10  # units of the drawing per pixel, so that integers suffice

COLORS = {"right": (205, 213, 226), "wrong": (236, 122, 92), "hull": (205, 213, 226),
          "unmet": (250, 190, 60), "cell": (120, 170, 220), "ghost": (238, 240, 244)}
OPACITY = {"hull": 0.55, "cell": 0.25}
TWO_SIDED = {"unmet", "cell"}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


class Eye:
    """A distant eye: azimuth from the x axis and height above the horizon, in degrees."""

    def __init__(self, azimuth_deg, height_deg):
        turn, height = math.radians(azimuth_deg), math.radians(height_deg)
        self.towards = (math.cos(height) * math.cos(turn), math.cos(height) * math.sin(turn),
                        math.sin(height))  # from the objects to the eye
        self.right = unit(cross((0, 0, 1), self.towards))
        self.up = cross(self.towards, self.right)
        self.light = unit(tuple(d + 0.9 * u - 0.6 * r for d, u, r in
                                zip(self.towards, self.up, self.right)))

    def flat(self, place):
        return dot(self.right, place), -dot(self.up, place)


class Frame:
    """Maps positions into a panel that contains given positions."""

    def __init__(self, eye, places):
        self.eye = eye
        seen = [eye.flat(place) for place in places]
        self.low = [min(s[k] for s in seen) for k in (0, 1)]
        size = [max(s[k] for s in seen) - self.low[k] for k in (0, 1)]
        self.scale = (PANEL_PX - 2 * MARGIN_PX) / max(size)
        self.pad = [(PANEL_PX - self.scale * size[k]) / 2 for k in (0, 1)]

    def at(self, place):
        """The position in fine units."""
        flat = self.eye.flat(place)
        x, y = ((flat[k] - self.low[k]) * self.scale + self.pad[k] for k in (0, 1))
        return round(FINE * x), round(FINE * y)


def shaded(kind, normal, eye):
    """The color of a facet, in few steps."""
    if kind in TWO_SIDED:
        bright = 0.85 + 0.15 * round(abs(dot(normal, eye.light)) * 16) / 16
    else:
        bright = 0.62 + 0.42 * round(max(dot(normal, eye.light), 0) * 16) / 16
    return "#" + "".join(f"{min(round(c * bright), 255):02x}" for c in COLORS[kind])


def depth_behind(facet, faces_eye, scenery, eye):
    """The depth of the cell in front of which the facet is painted."""
    a, b, c, _, cell, beyond = facet
    behind = cell if faces_eye else beyond
    center = scenery["centers"][behind] if behind >= 0 else None
    if center is None:  # a flat cell, or none
        center = [sum(x) / 3 for x in zip(*(scenery["points"][i] for i in (a, b, c)))]
    return dot(center, eye.towards)


def facets(scenery, drawn, frame):
    """The paths of facets in painting order."""
    eye, painted = frame.eye, []
    for number, facet in enumerate(drawn):
        corners = [scenery["points"][i] for i in facet[:3]]
        kind = facet[3]
        normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))
        faces_eye = dot(normal, eye.towards) > 0
        if not faces_eye and kind not in TWO_SIDED:
            continue
        (ax, ay), (bx, by), (cx, cy) = (frame.at(corner) for corner in corners)
        opacity = f' fill-opacity="{OPACITY[kind]}"' if kind in OPACITY else ""
        path = (f'<path fill="{shaded(kind, normal, eye)}"{opacity} '
                f'd="M{ax} {ay}L{bx} {by} {cx} {cy}Z"/>')
        painted.append((depth_behind(facet, faces_eye, scenery, eye), number, path))
    return [f'<g stroke="#47505f" stroke-width="{0.5 * FINE:g}" stroke-linejoin="round">',
            *(path for _, _, path in sorted(painted)), "</g>"]


def wires(scenery, frame):
    """All edges of the triangulation."""
    ends = [(frame.at(scenery["points"][a]), frame.at(scenery["points"][b]))
            for a, b in scenery["edges"]]
    path = "".join(f"M{ax} {ay}L{bx} {by}" for (ax, ay), (bx, by) in ends)
    return [f'<path fill="none" stroke="#7f8ba0" stroke-width="{0.4 * FINE:g}" d="{path}"/>']


def rays(lines, frame, reach):
    """Lines from points towards their views, as far as `reach`."""
    made = []
    for begin, end in lines:
        way = minus(end, begin)
        share = min(1.0, reach / math.sqrt(dot(way, way)))
        tip = [b + share * w for b, w in zip(begin, way)]
        (ax, ay), (bx, by) = frame.at(begin), frame.at(tip)
        made.append(f'<path stroke="#c03030" stroke-width="{1.2 * FINE:g}" '
                    f'd="M{ax} {ay}L{bx} {by}"/>'
                    f'<circle cx="{ax}" cy="{ay}" r="{2.5 * FINE:g}" fill="#c03030"/>')
    return made


def caption(lines, left_px, top_px=PANEL_PX):
    """Lines of text below a panel."""
    return [f'<text x="{FINE * (left_px + PANEL_PX // 2)}" y="{FINE * (top_px + LINE_PX * (i + 1))}" '
            f'text-anchor="middle" font-size="{FINE * (13 if i == 0 else 12)}" '
            f'fill="{"#202020" if i == 0 else "#606060"}">{line}</text>'
            for i, line in enumerate(lines)]


def picture(width_px, height_px, parts):
    """A complete file."""
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_px}" height="{height_px}" '
        f'viewBox="0 0 {FINE * width_px} {FINE * height_px}" font-family="sans-serif">',
        f'<rect width="{FINE * width_px}" height="{FINE * height_px}" fill="#fff"/>',
        *parts, "</svg>", ""])


def row_of_panels(scenery, eye, panels):
    """A picture of an object in several states, side by side. A panel has a caption, and optionally
    layers of facets, wires, rays and their reach, and facets that define its extent."""
    parts = []
    for i, panel in enumerate(panels):
        places = [scenery["points"][corner] for facet in panel.get("fit", [])
                  for corner in facet[:3]] or scenery["points"]
        frame = Frame(eye, places)
        parts.append(f'<svg x="{FINE * i * PANEL_PX}" width="{FINE * PANEL_PX}" '
                     f'height="{FINE * PANEL_PX}">')  # clips everything outside
        if panel.get("wires"):
            parts += wires(scenery, frame)
        for layer in panel.get("layers", []):
            parts += facets(scenery, layer, frame)
        parts += rays(panel.get("rays", []), frame, panel.get("reach", 1.0))
        parts += ["</svg>", *caption(panel["caption"], i * PANEL_PX)]
    lines = max(len(panel["caption"]) for panel in panels)
    return picture(PANEL_PX * len(panels), PANEL_PX + LINE_PX * lines + LINE_PX // 2, parts)


# ---- plots --------------------------------------------------------------------------------------

SERIES = ("#1f5fa8", "#c8442e", "#2e8b57", "#8a5cc2", "#b8860b")
PLOT_PX = (420, 330)
LEFT_PX, BOTTOM_PX, TOP_PX, RIGHT_PX = 62, 46, 28, 14


def fitted(points):
    """The factor and exponent of the best fit in logarithms: y = factor * x^exponent."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    exponent = (sum((x - mean_x) * (y - mean_y) for x, y in logs) /
                sum((x - mean_x) ** 2 for x, _ in logs))
    return math.exp(mean_y - exponent * mean_x), exponent


def seconds_text(seconds):
    for unit_name, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size * 0.999:
            return f"{seconds / size:g} {unit_name}"
    return f"{seconds / 1e-9:g} ns"


class Plot:
    """Logarithmic axes. `across` are the ticks of the horizontal axis, with their labels."""

    def __init__(self, left_px, title, across, values):
        self.left_px = left_px
        self.low_x, self.high_x = (math.log10(f(x for x, _ in across)) for f in (min, max))
        self.low_y = math.floor(math.log10(min(values)))
        self.high_y = math.ceil(math.log10(max(values)))
        width, height = PLOT_PX
        self.parts = [f'<text x="{FINE * (left_px + width // 2)}" y="{FINE * 16}" '
                      f'text-anchor="middle" font-size="{FINE * 13}" fill="#202020">{title}</text>']
        for y in range(self.low_y, self.high_y + 1):
            self._tick((self.low_x, y), (self.high_x, y), seconds_text(10.0 ** y), "end", (-6, 4))
        for x, text in across:
            x = math.log10(x)
            self._tick((x, self.low_y), (x, self.high_y), text, "middle", (0, 18))

    def _at(self, x, y):
        width, height = PLOT_PX
        share_x = (x - self.low_x) / (self.high_x - self.low_x)
        share_y = (y - self.low_y) / (self.high_y - self.low_y)
        return (round(FINE * (self.left_px + LEFT_PX + share_x * (width - LEFT_PX - RIGHT_PX))),
                round(FINE * (height - BOTTOM_PX - share_y * (height - BOTTOM_PX - TOP_PX))))

    def _tick(self, begin, end, text, anchor, shift_px):
        (ax, ay), (bx, by) = self._at(*begin), self._at(*end)
        self.parts.append(
            f'<path stroke="#dde1e7" stroke-width="{FINE}" d="M{ax} {ay}L{bx} {by}"/>'
            f'<text x="{ax + FINE * shift_px[0]}" y="{ay + FINE * shift_px[1]}" '
            f'text-anchor="{anchor}" font-size="{FINE * 11}" fill="#606060">{text}</text>')

    def below(self, text):
        width, height = PLOT_PX
        self.parts.append(f'<text x="{FINE * (self.left_px + (LEFT_PX + width) // 2)}" '
                          f'y="{FINE * (height - 8)}" text-anchor="middle" '
                          f'font-size="{FINE * 12}" fill="#202020">{text}</text>')

    def line(self, points, law, color):
        """Draws measured points, and the law through them."""
        factor, exponent = law
        ends = [(x, factor * x ** exponent) for x in (points[0][0], points[-1][0])]
        (ax, ay), (bx, by) = (self._at(math.log10(x), math.log10(y)) for x, y in ends)
        self.parts.append(f'<path stroke="{color}" stroke-width="{1.4 * FINE:g}" '
                          f'd="M{ax} {ay}L{bx} {by}"/>')
        for x, y in points:
            cx, cy = self._at(math.log10(x), math.log10(y))
            self.parts.append(f'<circle cx="{cx}" cy="{cy}" r="{3 * FINE}" fill="{color}"/>')


def legend(names, top_px):
    """A legend: the names of the series in their colors, in a row."""
    parts = []
    for i, name in enumerate(names):
        x = FINE * (20 + 240 * i)
        parts.append(f'<circle cx="{x}" cy="{FINE * top_px}" r="{4 * FINE}" fill="{SERIES[i]}"/>'
                     f'<text x="{x + 9 * FINE}" y="{FINE * (top_px + 4)}" '
                     f'font-size="{FINE * 12}" fill="#202020">{name}</text>')
    return parts
