# SPDX-License-Identifier: Apache-2.0
"""Writes matplotlib_maps.cpp and paraview_maps.cpp beside it: pip install matplotlib trame-vtk; python3 make_tables.py

matplotlib's maps of 256 colours are thinned to those entries between which straight lines keep every colour within 1/510.
ParaView's are its published control points in their own colour spaces, as the copy in trame-vtk's vtk.js holds them; where
one has the name of another of matplotlib's, matplotlib's is taken.
"""
import importlib.util
import json
import pathlib
import re

import matplotlib
import numpy

TOLERANCE = 1 / 510
SPACES = {"RGB": "Rgb", "Lab": "Lab", "CIELAB": "Lab", "HSV": "Hsv", "Diverging": "Diverging"}
HEAD = """// SPDX-License-Identifier: Apache-2.0
//
// Written by make_tables.py. Each node is sixteen hexadecimal digits: place, red, green and blue, four digits each, of 65535
// over the whole; a categorical map's colours have twelve.
{notice}
#include <preint/color_maps/color_map_table.h>

namespace tetralux::preint {{

// clang-format off
const std::vector<ColorMapText>& {function}() {{
    static const std::vector<ColorMapText> all{{
{rows}
    }};
    return all;
}}
// clang-format on

}}  // namespace tetralux::preint
"""
MATPLOTLIB_NOTICE = """//
// Colours of matplotlib (matplotlib.org, PSF-based licence): viridis, inferno, plasma, magma (S. van der Walt, N. Smith,
// E. Firing: CC0), cividis (J. Nunez, C. Anderton, R. Renslow), turbo (A. Mikhailov, Google: Apache-2.0), maps of
// ColorBrewer (C. Brewer, M. Harrower, The Pennsylvania State University: Apache-2.0), of yorick (BSD) and matplotlib's own."""
PARAVIEW_NOTICE = """//
// Control points of ParaView's and VTK's colour maps (Kitware, Sandia National Laboratories: BSD-3-Clause), among them those
// of F. Samsel (Los Alamos National Laboratory) and K. Moreland ("Diverging Color Maps for Scientific Visualization", 2009)."""


def folded(name):
    return re.sub("[^a-z0-9]", "", name.lower())


def digits(values):
    return "".join(f"{int(round(float(v) * 65535)):04x}" for v in values)


def thinned(places, colors):
    """Places and colours of as few nodes as keep straight lines within TOLERANCE of every colour."""
    kept = [0]
    while kept[-1] < len(places) - 1:
        first = kept[-1]
        last = first + 1
        for end in range(first + 2, len(places)):
            share = (places[first:end + 1] - places[first]) / (places[end] - places[first])
            line = colors[first] + share[:, None] * (colors[end] - colors[first])
            if numpy.abs(line - colors[first:end + 1]).max() > TOLERANCE:
                break
            last = end
        kept.append(last)
    return places[kept], colors[kept]


def row(name, space, text):
    pieces = [text[i:i + 112] for i in range(0, len(text), 112)]
    return f'        {{"{name}", MapKind::{space},\n' + "\n".join(f'         "{p}"' for p in pieces) + "},"


def categorical_row(name, colors):
    text = "".join(digits(color) for color in colors)
    return row(name, "Categorical", text)


def matplotlib_rows():
    rows = {}
    for name, colormap in sorted(matplotlib.colormaps.items(), key=lambda item: item[0].lower()):
        if name.endswith("_r") or folded(name) in rows:
            continue
        listed = isinstance(colormap, matplotlib.colors.ListedColormap)
        if listed and colormap.N < 64:
            rows[folded(name)] = categorical_row(name, numpy.array(colormap.colors)[:, :3])
            continue
        places = numpy.linspace(0, 1, colormap.N)
        where, colors = thinned(places, colormap(numpy.arange(colormap.N))[:, :3])
        nodes = "".join(digits([p, *c]) for p, c in zip(where, colors))
        rows[folded(name)] = row(name, "Rgb", nodes)
    return rows


def paraview_maps():
    folder = importlib.util.find_spec("trame_vtk").submodule_search_locations[0]
    text = (pathlib.Path(folder) / "modules/common/serve/trame-vtk.js").read_text()
    inside = text.index('"ColorSpace":"Diverging","Name":"Cool to Warm"')
    start = text.rindex("JSON.parse('", 0, inside) + len("JSON.parse('")
    return json.loads(text[start:text.index("')", inside)])


def paraview_rows(taken):
    rows = {}
    for colormap in paraview_maps():
        name = colormap["Name"]
        if folded(name) in taken or folded(name) in rows or name.endswith("(matplotlib)"):
            continue
        if re.fullmatch(r"Brewer .*\(\d+\)|Brewer Qualitative .*", name):
            continue  # matplotlib has them under shorter names
        if "IndexedColors" in colormap:
            rows[folded(name)] = categorical_row(name, numpy.reshape(colormap["IndexedColors"], (-1, 3)))
            continue
        points = numpy.reshape(colormap["RGBPoints"], (-1, 4))
        low, high = points[0, 0], points[-1, 0]
        nodes = "".join(digits([(p[0] - low) / (high - low), *numpy.clip(p[1:], 0, 1)]) for p in points)
        rows[folded(name)] = row(name, SPACES[colormap["ColorSpace"]], nodes)
    return rows


def main():
    here = pathlib.Path(__file__).parent
    ours = matplotlib_rows()
    theirs = paraview_rows(set(ours))
    for file, rows, function, notice in (("matplotlib_maps.cpp", ours, "matplotlibMaps", MATPLOTLIB_NOTICE),
                                         ("paraview_maps.cpp", theirs, "paraViewMaps", PARAVIEW_NOTICE)):
        (here / file).write_text(HEAD.format(notice=notice, function=function, rows="\n".join(rows.values())))
        print(file, len(rows), "maps")


main()
