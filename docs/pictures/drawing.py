"""Writes a drawing as an SVG that is dark or bright as the reader's screen is, and needs nothing else."""

import math
from xml.sax.saxutils import escape

# The colours of each class: bright, dark. "-line" is a stroke, "-area" a fill.
INKS = {
    "paper": ("#ffffff", "#0f1622"),
    "frame": ("#d5dce6", "#2b3648"),
    "ink": ("#1b2533", "#e8eef7"),
    "quiet": ("#5b6879", "#9aa9bd"),
    "faint": ("#e6ebf2", "#202b3b"),
    "body": ("#2f6bd8", "#78a8ff"),
    "other": ("#7b61c4", "#b39dfa"),
    "probe": ("#c2500f", "#ffae70"),
    "contact": ("#cf1f46", "#ff6b86"),
    "sure": ("#16794a", "#5ad69a"),
    "open": ("#8a6100", "#f2c14e"),
}


def number(value):
    """Returns a coordinate in tenths of a unit, as short as can be."""
    text = f"{value:.1f}"
    return "0" if text in ("0.0", "-0.0") else text.removesuffix(".0")


def points(pairs):
    return " ".join(f"{number(x)},{number(y)}" for x, y in pairs)


def text_class(class_):
    """The ink comes first; further words are classes of their own."""
    ink, *more = class_.split()
    return " ".join([f"{ink}-text", *more])


class Drawing:
    def __init__(self, width, height, title, about, size=20):
        """Text is `size` high. A picture 640 wide is about half as large on a phone."""
        self.width, self.height, self.title, self.about, self.size = width, height, title, about, size
        self.parts = []

    def add(self, tag, inner=None, **attributes):
        """Appends an element; names end in _ where Python has the word, and _ stands for -."""
        named = "".join(
            f' {name.rstrip("_").replace("_", "-")}="{number(value) if isinstance(value, float) else value}"'
            for name, value in attributes.items()
        )
        self.parts.append(f"<{tag}{named}/>" if inner is None else f"<{tag}{named}>{inner}</{tag}>")

    def circle(self, x, y, r, class_, **more):
        self.add("circle", cx=float(x), cy=float(y), r=float(r), class_=class_, **more)

    def dots(self, places, radius, ink, **more):
        """Discs of one size, in a tenth of the bytes that circles take."""
        path = "".join(f"M{number(x)} {number(y)}h0" for x, y in places)
        self.add("path", d=path, class_=f"{ink}-line", style=f"stroke-width:{number(2 * radius)}", **more)

    def tails(self, places, ways, ink):
        """A line from each place, by a way of its own."""
        pairs = zip(places, ways, strict=True)
        path = "".join(f"M{number(x)} {number(y)}l{number(u)} {number(v)}" for (x, y), (u, v) in pairs)
        self.add("path", d=path, class_=f"{ink}-line", style="stroke-width:2")

    def line(self, x1, y1, x2, y2, class_, **more):
        self.add("line", x1=float(x1), y1=float(y1), x2=float(x2), y2=float(y2), class_=class_, **more)

    def curve(self, pairs, class_, **more):
        self.add("polyline", points=points(pairs), class_=class_, **more)

    def area(self, pairs, class_, **more):
        self.add("polygon", points=points(pairs), class_=class_, **more)

    def rect(self, x, y, width, height, class_, **more):
        self.add(
            "rect", x=float(x), y=float(y), width=float(width), height=float(height), class_=class_, **more
        )

    def text(self, x, y, words, class_="ink", anchor="start", **more):
        self.add(
            "text",
            escape(words),
            x=float(x),
            y=float(y),
            class_=text_class(class_),
            text_anchor=anchor,
            **more,
        )

    def capsule(self, start, end, r, class_, **more):
        """What a circle of radius r covers on its way from start to end."""
        length = math.dist(start, end)
        u, v = r * (end[0] - start[0]) / length, r * (end[1] - start[1]) / length
        corners = [
            (start[0] + v, start[1] - u),
            (end[0] + v, end[1] - u),
            (end[0] - v, end[1] + u),
            (start[0] - v, start[1] + u),
        ]
        a, b, c, d = (f"{number(x)} {number(y)}" for x, y in corners)
        turn = f"A{number(r)} {number(r)} 0 0 1"
        self.add("path", d=f"M{a}L{b}{turn} {c}L{d}{turn} {a}Z", class_=class_, **more)

    def arrow(self, x1, y1, x2, y2, class_):
        """A line with a head at its second end."""
        length = math.dist((x1, y1), (x2, y2))
        u, v = (x2 - x1) / length, (y2 - y1) / length
        self.line(x1, y1, x2 - 5 * u, y2 - 5 * v, f"{class_}-line")
        head = [
            (x2, y2),
            (x2 - 10 * u - 4.5 * v, y2 - 10 * v + 4.5 * u),
            (x2 - 10 * u + 4.5 * v, y2 - 10 * v - 4.5 * u),
        ]
        self.area(head, f"{class_}-area")

    def words(self):
        return f"<title>{escape(self.title)}</title><desc>{escape(self.about)}</desc>"

    def content(self):
        return [
            f'<rect class="paper-area" width="{self.width}" height="{self.height}" rx="12"/>',
            *self.parts,
        ]

    def svg(self):
        return whole(self, self.content(), [self.words()])


def whole(drawing, content, head=()):
    """An SVG of the size of a drawing, with a head before its styles."""
    sides = [
        "".join(
            f".{name}-line{{stroke:{colours[side]}}}.{name}-area,.{name}-text{{fill:{colours[side]}}}"
            for name, colours in INKS.items()
        )
        for side in (0, 1)
    ]
    style = (
        f"text{{font:500 {drawing.size}px system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif}}"
        "[class$=line]{fill:none;stroke-width:2;stroke-linecap:round;stroke-linejoin:round}"
        f".small{{font-size:18px}}.bold{{font-weight:700}}{sides[0]}"
        f"@media(prefers-color-scheme:dark){{{sides[1]}}}"
    )
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {drawing.width} {drawing.height}" '
        f'width="{drawing.width}" height="{drawing.height}" role="img">',
        *head,
        f"<style>{style}</style>",
        *content,
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


class Sheet:
    """Drawings of one size in one file. A page shows one of them by its name: FILE.svg#NAME."""

    def __init__(self, drawings):
        self.drawings = drawings

    def svg(self):
        first, *others = self.drawings.values()
        content = []
        for k, (name, one) in enumerate(self.drawings.items()):
            assert (one.width, one.height, one.size) == (first.width, first.height, first.size), name
            top = k * one.height
            content.append(f'<view id="{name}" viewBox="0 {top} {one.width} {one.height}"/>')
            content += [f'<g transform="translate(0 {top})">', one.words(), *one.content(), "</g>"]
        return whole(first, content)
