"""Bars as SVG, the same bytes for the same numbers."""

from html import escape

WIDTH, LABELS, BAR, GAP, TITLE = 760, 150, 15, 14, 34
ROOM = 150  # after the longest bar, for its number
COLORS = {
    "glint": "#2b6cb0", "glint, no shader cache": "#90cdf4", "Embree": "#dd6b20", "POV-Ray": "#2f855a", "Tachyon": "#97266d",
}
OTHER = "#718096"


def text(x, y, words, size=12, anchor="start", weight="normal"):
    return (f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}" fill="#1a202c">'
            f"{escape(words)}</text>")


def legend(names, y):
    parts, x = [], LABELS
    for name in names:
        color = COLORS.get(name, OTHER)
        parts.append(f'<rect x="{x}" y="{y - 10}" width="11" height="11" fill="{color}"/>')
        parts.append(text(x + 16, y, name))
        x += 34 + int(6.6 * len(name))
    return parts


def bars(title, names, rows, unit):
    """`rows`: a label and a number, or None, for each of the names. The longest bar is the greatest number of all."""
    most = max(value for _, values in rows for value in values if value is not None)
    per_unit = (WIDTH - LABELS - ROOM) / most
    parts, y = [text(10, 22, title, 15, weight="bold")] + legend(names, TITLE + 12), TITLE + 34
    for label, values in rows:
        shown = [(value, COLORS.get(name, OTHER)) for name, value in zip(names, values) if value is not None]
        parts.append(text(LABELS - 8, y + len(shown) * BAR / 2 + 4, label, anchor="end"))
        for value, color in shown:
            parts.append(f'<rect x="{LABELS}" y="{y}" width="{max(1, round(value * per_unit))}" height="{BAR - 2}" fill="{color}"/>')
            parts.append(text(LABELS + round(value * per_unit) + 5, y + BAR - 4, f"{value:.3g}{unit}", 11))
            y += BAR
        y += GAP
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{y}" viewBox="0 0 {WIDTH} {y}" '
            'font-family="Helvetica, Arial, sans-serif">')
    return "\n".join([head, f'<rect width="{WIDTH}" height="{y}" fill="#ffffff"/>', *parts, "</svg>", ""])
