"""Figures of results on matplotlib, tables as pandas and xarray know them."""

STROKES = {"solid": "-", "dashed": "--", "dotted": ":", "dash_dotted": "-."}
SHAPES = {"ring": "o", "disc": "o", "square": "s", "triangle": "^", "diamond": "D", "cross": "x"}


def plot(figure, ax):
    """Draws the panels of a figure; returns the axes, an array of them where there are several panels."""
    panels = figure["panels"]
    if ax is None:
        import matplotlib.pyplot as pyplot

        height = 4.6 if len(panels) == 1 else 2.9 * len(panels)
        _, grid = pyplot.subplots(len(panels), 1, figsize=(8, height), squeeze=False, layout="constrained")
        axes = grid[:, 0]
    else:
        axes = list(getattr(ax, "flat", [ax]))
    for panel, each in zip(panels, axes):
        draw(panel, each)
    axes[0].set_title(figure["title"])
    if any(label for each in axes for label in each.get_legend_handles_labels()[1]):
        axes[0].legend(fontsize="small")
    return axes[0] if ax is None and len(panels) == 1 else (axes if ax is None else ax)


def draw(panel, ax):
    """Draws one panel."""
    for band in panel["bands"]:
        places, low, high = zip(*band["edges"])
        ax.fill_between(places, low, high, color=band["colour"], alpha=0.22, linewidth=0, label=band["label"] or None)
    for bars in panel["bars"]:
        label = bars["label"] or None
        for left, right, low, high in bars["bars"]:
            ax.bar(left, high - low, right - left, low, align="edge", color=bars["colour"], alpha=0.75, label=label)
            label = None
    for mark in panel["marks"]:
        ax.axvline(mark["at"], color="0.4", linewidth=1, linestyle="--", label=mark["label"] or None)
    for curve in panel["curves"]:
        label = curve["label"] or None
        for piece in curve["pieces"]:
            ax.plot(*zip(*piece), color=curve["colour"], linestyle=STROKES[curve["stroke"]], label=label)
            label = None
    for errors in panel["error_bars"]:
        for bar in errors["bars"]:
            ax.plot(*zip(bar["low"], bar["high"]), color=errors["colour"], linewidth=1)
        points(ax, errors, [bar["at"] for bar in errors["bars"]])
    for markers in panel["markers"]:
        points(ax, markers, markers["points"])
    for label in panel["labels"]:
        ax.annotate(label["text"], label["at"], xytext=(5, 5), textcoords="offset points", fontsize="small")
    for axis, set_label, set_range, set_ticks in (
        (panel["x"], ax.set_xlabel, ax.set_xlim, ax.set_xticks),
        (panel["y"], ax.set_ylabel, ax.set_ylim, ax.set_yticks),
    ):
        set_label(f"{axis['name']} [{axis['unit']}]" if axis["unit"] else axis["name"])
        if axis["categories"]:
            set_ticks(range(len(axis["categories"])), axis["categories"])
        set_range(*axis["range"])
    if panel["x"]["categories"]:
        ax.tick_params(axis="x", labelrotation=45)
    if panel["y"]["logarithmic"]:
        ax.set_yscale("log")
    if panel["equal_scales"]:
        ax.set_aspect("equal", adjustable="datalim")
    ax.grid(True, alpha=0.3)


def points(ax, markers, places):
    """Draws separate points."""
    hollow = {"facecolors": "none", "edgecolors": markers["colour"]} if markers["shape"] in ("ring", "square") else {"color": markers["colour"]}
    ax.scatter(*zip(*places), marker=SHAPES[markers["shape"]], s=28, zorder=3, label=markers["label"] or None, **hollow)


def frame(table):
    """The table as a pandas.DataFrame."""
    import pandas

    return pandas.DataFrame(table)


def dataset(table, name):
    """The table as an xarray.Dataset: its axes are the first column, and as many columns of words and counts as tell its rows apart."""
    from pandas.api.types import is_float_dtype

    rows = frame(table)
    telling = [key for key in rows if not is_float_dtype(rows[key].dtype) and rows[key].nunique(dropna=False) > 1]
    axes = []
    for key in dict.fromkeys([rows.columns[0], *telling]):
        axes.append(key)
        if not rows.duplicated(axes).any():
            break
    else:
        raise ValueError(f"the rows of the table {name or 'of the answer'} have no axes: take to_frame()")
    data = rows.set_index(axes).to_xarray()
    for key in [*data.coords, *data.data_vars]:
        if key.endswith("]") and " [" in key:
            short, unit = key[:-1].rsplit(" [", 1)
            data = data.rename({key: short})
            data[short].attrs["units"] = unit
    return data


class Page:
    """A page of HTML, which a notebook shows."""

    def __init__(self, html):
        self.html = html

    def _repr_html_(self):
        from html import escape

        return f'<iframe srcdoc="{escape(self.html)}" width="100%" height="640" style="border: 0"></iframe>'

    def save(self, path):
        """Writes the page for a browser."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)
