# SPDX-License-Identifier: Apache-2.0
"""What the gallery draws: for each picture its mesh, its transfer function and the options of `tetralux render`."""
import math


def tents(*peaks, half=0.2):
    """Narrow peaks of extinction: (scalar, τ, colour)."""
    return {"color": [[s + d * 1.5 * half, *c] for s, _, c in peaks for d in (-1, 1)],
            "extinction": [[s + d * half, tau * (1 - abs(d))] for s, tau, _ in peaks for d in (-1, 0, 1)]}


def isosurfaces(*surfaces, normalized=False):
    """(scalar, opacity, colour)."""
    return {"normalized": normalized, "isosurfaces": [{"value": s, "opacity": a, "color": c} for s, a, c in surfaces]}


def constant(extinction, color):
    return {"color": [[0, *color]], "extinction": [[0, extinction]]}


BLUE, RED, SAND, GOLD = (0.3, 0.55, 1.0), (1.0, 0.3, 0.2), (0.75, 0.6, 0.45), (1.0, 0.72, 0.3)
SMOOTH = ["--normals", "smooth"]


def kraus(draw, volumes):
    eye = ["--eye", "0.5,0.5,3.2", "--fov", "22"]
    coulomb, outer, inner = "coulomb:49", 5.0, 8.6
    surfaces = isosurfaces((outer, 0.3, BLUE), (inner, 0.55, RED))
    scale = ["--mode", "scale-invariant"]
    draw("kraus-1a", coulomb, {"color": [[1, 1, 1, 1], [10, 1, 1, 1]], "extinction": [[1, 0]]}, eye +
         ["--window", "7,10", "--slice", "0.5,0.5,0.5,0,0,1", "--isolines", "18", "--isoline-color", "0,0,0", "--background", "1,1,1"])
    draw("kraus-1b", coulomb, tents((outer, 36, BLUE), (inner, 150, RED), half=0.06), eye)
    draw("kraus-1c", coulomb, surfaces, eye + scale)
    draw("kraus-1d", coulomb, surfaces, eye + scale + ["--silhouette"])

    lamp = ["--light", "0.4,0.7,1", "--ambient", "0.2", "--exponent", "24"]
    draw("kraus-2a", coulomb, surfaces, eye + scale)
    draw("kraus-2b", coulomb, surfaces, eye + scale + SMOOTH + lamp)
    veil, whole = constant(0.22, (0.95, 0.8, 0.55)), ["--eye", "0.5,0.5,3.2", "--fov", "27"] + scale
    draw("kraus-3a", coulomb, veil, whole)
    draw("kraus-3b", coulomb, veil, whole + ["--isosurfaces", "24", "--unlit"])
    draw("kraus-5a", coulomb, surfaces, eye + scale + ["--silhouette"])
    draw("kraus-5b", coulomb, surfaces, eye + scale + ["--silhouette=approximate"])

    lit = eye + scale + SMOOTH + ["--silhouette"]
    behind_viewer, behind = ["--light", "0.25,0.35,1"], ["--light", "0.25,0.35,-1"]
    dim = {"ambient": 0.12, "exponent": 8}
    for name, light, more in (("a", behind_viewer, {}), ("b", behind, {"transmission": False}),
                              ("c", behind, {"material": {"specular_transmission": 0}}), ("d", behind, {})):
        draw("kraus-6" + name, coulomb, isosurfaces((outer, 0.4, BLUE), (inner, 0.6, RED)), lit + light, lighting=dict(dim, **more))

    signal = ["--eye", "2.6,1.9,4.2", "--up", "0,0,1", "--fov", "34"]
    green = (0.45, 0.9, 0.5)
    draw("kraus-8a", "marschner-lobb:65", tents((0.5, 18, green), half=0.02), signal)
    draw("kraus-8b", "marschner-lobb:65", isosurfaces((0.5, 0.2, green)), signal + scale + ["--silhouette"])
    orbital, probability = ["--eye", "62,30,48", "--up", "0,0,1", "--fov", "25"], 0.05
    draw("kraus-8c", "hydrogen:65", tents((probability, 0.9, GOLD), half=0.01), orbital)
    draw("kraus-8d", "hydrogen:65", isosurfaces((probability, 0.25, GOLD)), orbital + scale + ["--silhouette"])
    ball = ["--eye", "1.9,1.4,2.3", "--fov", "24"]
    shells = {"normalized": True, "color": [[0, 0.1, 0.25, 0.6], [0.3, 0.15, 0.5, 0.9], [0.6, 0.95, 0.7, 0.4], [1, 0.85, 0.15, 0.05]],
              "extinction": [[0, 0], [0.12, 0], [0.25, 2], [0.4, 0.6], [0.6, 3], [0.75, 30], [1, 45]]}
    draw("kraus-8e", "bucky:32", shells, ball)
    draw("kraus-8f", "bucky:32", shells, ball + scale + ["--silhouette"])


def lobe(kind, gamma, **more):
    return ["--reflectance", kind, "--anisotropy", ",".join(f"{k}={v}" for k, v in dict(gamma=gamma, **more).items())]


def ament(draw, volumes):
    dull = {"normalized": False, "color": [[0, *SAND]], "extinction": [[0, 0], [0.05, 60], [0.6, 60]]}
    solid = ["--eye", "3.5,-1.5,1", "--up", "0,0,1", "--fov", "34"] + SMOOTH
    lamp = ["--light", "1,1,-0.2", "--ambient", "0.15", "--no-transmission"]
    # as wide as (n·H)^100, and as bright in the middle where γ = 0: Ward's lobe is normalized
    ward, bright = {"kappa": 0.02}, {"material": {"specular": round(4 * math.pi * 0.02, 3)}}
    for name, axes in (("sphere", (0.7, 0.7, 0.7)), ("ellipsoid", (0.45, 0.45, 0.9)), ("cylinder", (0.4, 0.4, math.inf))):
        field = volumes(name, "ellipsoid", *axes)
        ends = ["--clip-box=-1,1,-1,1,-0.75,0.75"] if name == "cylinder" else []
        for kind, gamma in (("isotropic", 0), ("anisotropic", 10)):
            draw(f"ament-2-{name}-{kind}", field, dull, solid + lamp + ends + lobe("ward", gamma, **ward), lighting=bright)

    packed = volumes("packed", "packed_ellipsoids")
    row = ["--eye", "3,-30,6.75", "--up", "0,0,1", "--fov", "27"] + SMOOTH + ["--light", "0.15,-1,0.1", "--ambient", "0.15", "--no-transmission"]
    kept = "anisotropy(radius=2,interval=0.05,samples=4,smoothing=0) of s"  # taken up in the place of an estimate
    draw("ament-5a", volumes("packed-curvatures", "packed_ellipsoids", kept), dull, row + lobe("ward", 3, radius=2, **ward), lighting=bright)
    for name, radius in (("b", 2), ("c", 8)):
        draw("ament-5" + name, packed, dull, row + lobe("ward", 10, radius=radius, **ward), lighting=bright)

    field = volumes("ellipsoid", "ellipsoid", 0.45, 0.45, 0.9)
    study = {"a": (60, 6, 0.02, 4, 0), "b": (10, 6, 0.02, 4, 0), "c": (60, 1, 0.02, 4, 0), "d": (10, 1, 0.02, 4, 0),
             "e": (60, 6, 0.5, 4, 0), "f": (10, 6, 0.5, 4, 0), "g": (60, 6, 0.02, 1, 0), "h": (60, 6, 0.02, 1, 8)}
    for name, (gamma, radius, interval, samples, smoothing) in study.items():
        estimate = dict(radius=radius, interval=interval, samples=samples, smoothing=smoothing)
        draw("ament-6" + name + "-ward", field, dull, solid + lamp + lobe("ward", gamma, **estimate, **ward), lighting=bright)
        draw("ament-6" + name + "-lafortune", field, dull, solid + lamp + lobe("lafortune", gamma, **estimate, kappa=25))

    rings = {"normalized": True, "color": [[0, *SAND]], "extinction": [[0, 0], [0.5, 0], [0.53, 60], [1, 60]]}
    signal = ["--eye", "2.6,1.9,4.2", "--up", "0,0,1", "--fov", "41", "--light", "1,1,2", "--ambient", "0.15", "--no-transmission"] + SMOOTH
    unlit = signal + ["--reflectance", "none"]
    draw("ament-7-unlit", "marschner-lobb:41", rings, unlit)
    draw("ament-7a", "marschner-lobb:41", rings, signal + ["--reflectance", "blinn-phong", "--exponent", "64"], unlit="ament-7-unlit")
    for name, gamma in (("0", 0), ("b", 10), ("c", 60)):
        draw(f"ament-7{name}-ward", "marschner-lobb:41", rings, signal + lobe("ward", gamma, kappa=0.031), lighting={"material": {"specular": 0.39}},
             unlit="ament-7-unlit")
        draw(f"ament-7{name}-lafortune", "marschner-lobb:41", rings, signal + lobe("lafortune", gamma, kappa=16), unlit="ament-7-unlit")

    tangle = volumes("tubes", "tubes")
    clear = {"normalized": False, "color": [[0, 0.35, 0.6, 0.95], [0.5, 0.4, 0.75, 0.9], [1, 0.95, 0.85, 0.6]],
             "extinction": [[0, 0], [0.25, 0], [0.4, 25], [1, 60]]}
    look = ["--eye", "3.1,2.2,3.9", "--fov", "36", "--light", "0.5,1,0.6", "--ambient", "0.1", "--no-transmission"] + SMOOTH
    draw("ament-1a", tangle, clear, look + ["--reflectance", "henyey-greenstein"])
    phase = look + ["--phase-asymmetry", "0"]
    draw("ament-1b", tangle, clear, phase + ["--reflectance", "blinn-phong", "--exponent", "40"])
    draw("ament-1c", tangle, clear, phase + lobe("lafortune", 10, kappa=10, radius=3))

    shell = {"normalized": True, "color": [[0, 0.3, 0.55, 1], [0.4, 0.5, 0.7, 0.9], [0.7, 1, 0.7, 0.4], [1, 0.9, 0.4, 0.2]],
             "extinction": [[0, 0], [0.15, 0], [0.25, 2], [0.5, 3], [0.62, 60], [1, 90]]}
    ball = ["--eye", "1.9,1.4,2.3", "--fov", "24", "--light", "1,2,2", "--ambient", "0.25", "--no-transmission"] + SMOOTH
    for name, exponent, kappa in (("high", 120, 30), ("low", 20, 5)):
        draw(f"ament-10-{name}-blinn-phong", "bucky:32", shell, ball + ["--reflectance", "blinn-phong", "--exponent", str(exponent)])
        draw(f"ament-10-{name}-lafortune", "bucky:32", shell, ball + lobe("lafortune", 50, kappa=kappa))


def marchesin(draw, volumes):
    dense = {"normalized": True, "color": [[0, 0.2, 0.35, 0.9], [0.3, 0.2, 0.8, 0.9], [0.6, 0.95, 0.7, 0.3], [1, 0.9, 0.2, 0.1]],
             "extinction": [[0, 0], [0.1, 0], [0.2, 20], [0.5, 30], [1, 60]]}
    ball = ["--eye", "1.9,1.4,2.3", "--fov", "24"]
    adaptive = ball + ["--adaptive", "cells"]
    mesh = "bucky:32"

    def cells(most, kind):
        return adaptive + ["--adaptive-max", str(most), "--adaptive-filter", kind]

    draw("marchesin-2a", mesh, dense, adaptive + ["--mode", "contributions", "--adaptive-filter", "none"])
    for name, most, kind in (("b", 1, "none"), ("c", 0.25, "none"), ("d", 0.12, "none"), ("e", 0.12, "gaussian"), ("f", 0.12, "2x"), ("g", 0.12, "4x")):
        draw("marchesin-2" + name, mesh, dense, cells(most, kind), samples=1)
    draw("marchesin-2h", mesh, dense, cells(0.12, "gaussian") + ["--depth-color", "0.1,0.15,0.4,0.9"])
    coarse, sharp = "bucky:16", {"normalized": True, "color": [[0, 0.2, 0.35, 0.9], [0.3, 0.2, 0.8, 0.9], [0.32, 0.95, 0.7, 0.3], [1, 0.9, 0.2, 0.1]],
                                 "extinction": [[0, 0], [0.2, 0], [0.2, 20], [1, 60]]}
    additive = ["--mode", "additive"]
    for name, how in (("samples", "post"), ("preintegrated", "preintegrated")):
        draw(f"marchesin-3-{name}", coarse, sharp, ball + additive + ["--adaptive", "length", "--classification", how])
    draw("marchesin-6-standard", mesh, dense, ball)
    draw("marchesin-6-adaptive", mesh, dense, ball + additive + ["--adaptive", "length"])
    tangle = volumes("tubes", "tubes")
    strands = {"color": [[0, 0.2, 0.4, 0.95], [0.5, 0.3, 0.8, 0.8], [1, 1, 0.75, 0.3]], "extinction": [[0, 0], [0.15, 0], [0.3, 20], [1, 40]]}
    around = ["--eye", "3.1,2.2,3.9", "--fov", "36"]
    for data, source, function, view in (("ball", mesh, dense, ball), ("tubes", tangle, strands, around)):
        for kind, options in (("compositing", []), ("compositing-adaptive", ["--adaptive", "length"]), ("additive", additive),
                              ("additive-adaptive", additive + ["--adaptive", "length"])):
            draw(f"marchesin-7-{data}-{kind}", source, function, view + options)


def lecture(draw, volumes):
    mesh, ball, around = "bucky:48", ["--eye", "1.9,1.4,2.3", "--fov", "24"], ["--eye", "1.9,1.4,2.3", "--fov", "33"]
    clouds = {"normalized": True, "color": [[0, 0.1, 0.2, 0.6], [0.3, 0.2, 0.5, 0.9], [0.6, 0.95, 0.75, 0.4], [1, 0.95, 0.3, 0.1]],
              "extinction": [[0, 0], [0.1, 0.5], [0.4, 4], [0.6, 12], [1, 60]]}
    surface = dict(clouds, extinction=[[0, 0], [0.35, 0], [0.45, 40], [1, 60]])
    faint = dict(clouds, extinction=[[0, 0], [0.1, 0], [0.5, 1], [1, 5]])
    lamp = SMOOTH + ["--light", "1,2,2", "--ambient", "0.25", "--no-transmission"]

    middle = ["--slice", "0.5,0.5,0.5,0,0,1", "--clip-plane", "0.5,0.5,0.5,0,0,-1", "--eye", "0.5,0.5,3", "--height", "1.06"]
    draw("lecture-slice", mesh, "viridis", middle)
    draw("lecture-isolines", mesh, "viridis", middle + ["--isolines", "9"])
    draw("lecture-hybrid", mesh, dict(clouds, isosurfaces=[{"value": 0.6, "opacity": 0.9, "color": [0.95, 0.6, 0.25]}]),
         around + lamp + ["--slice", "0.5,0.5,0.42,0,0,1", "--isolines", "9"])
    body = ["--slice", "0,0,0,0,0,1", "--clip-plane", "0,0,0,0,0,-1", "--eye", "0,0,5", "--height", "2.1"]
    for name, window in (("full", "127.5,256"), ("soft", "35,50"), ("dense", "190,100")):
        draw("lecture-window-" + name, volumes("bytes", "bytes"), "grayscale", body + ["--window", "dicom:" + window])
    for name in ("grayscale", "rainbow", "black-body", "cool-to-warm", "blue-to-yellow"):
        draw("lecture-colors-" + name, mesh, name, middle)
    draw("lecture-accumulate", mesh, clouds, ball)
    draw("lecture-first-hit", mesh, isosurfaces((0.45, 1.0, (0.95, 0.6, 0.25))), ball + lamp + ["--mode", "first-hit"])
    draw("lecture-average", mesh, {"normalized": True, "color": [[0, 0, 0, 0], [0.25, 1, 1, 1]], "extinction": [[0, 1]]}, ball + ["--mode", "average"])
    draw("lecture-maximum", mesh, "grayscale", ball + ["--mode", "mip"])
    draw("lecture-emission", mesh, faint, ball + ["--mode", "emission"])
    draw("lecture-absorption", mesh, faint, ball + ["--mode", "absorption"])
    draw("lecture-depth", mesh, surface, ball + ["--mode", "depth"])
    draw("lecture-light-none", mesh, surface, ball)
    draw("lecture-light-diffuse", mesh, surface, ball + SMOOTH,
         lighting={"ambient": 0.25, "transmission": False, "lights": [LAMP], "material": {"specular": 0}})
    draw("lecture-light-specular", mesh, surface, ball + lamp)
    draw("lecture-clipping", mesh, surface, ball + lamp + ["--clip-plane", "0.5,0.5,0.55,0,0,-1"])
    for name in ("post", "preintegrated"):
        draw("lecture-classification-" + name, "bucky:24", bands(), ball + ["--classification", name])


LAMP = {"type": "directional", "towards": [1, 2, 2]}


def bands():
    """Thin layers of one colour each: what samples and vertices miss."""
    colors = ((0.2, 0.4, 1), (0.2, 0.9, 0.4), (1, 0.8, 0.2), (1, 0.3, 0.2))
    function = {"normalized": True, "color": [], "extinction": [[0, 0]]}
    for s, color in zip((0.15, 0.35, 0.55, 0.8), colors):
        function["color"] += [[s - 0.04, *color], [s + 0.04, *color]]
        function["extinction"] += [[s - 0.02, 0], [s, 80], [s + 0.02, 0]]
    return function


def hybrid(draw, volumes):
    draw("hybrid", "bucky:64", "bucky.json", ["--mode", "scale-invariant", "--silhouette", "--light", "1,2,2", "--ambient", "0.3", "--slice",
         "0.5,0.5,0.3,0,0,1", "--isolines", "8", "--surface", volumes("octahedron", "octahedron"), "--surface-color", "0.95,0.85,0.3",
         "--clip-plane=0.5,0.5,0.62,-0.2,0,-1", "--eye", "2,1.4,2.4", "--fov", "24"] + SMOOTH)


def ramp(map_, extinction):
    """Colours over the field's range, and extinction per unit of length."""
    return {"normalized": True, "color": [[i / (len(map_) - 1), *c] for i, c in enumerate(map_)], "extinction": extinction}


COOL_WARM = ((0.23, 0.3, 0.75), (0.55, 0.69, 1.0), (0.87, 0.87, 0.87), (0.96, 0.6, 0.48), (0.71, 0.02, 0.15))
FLAME = ((0.1, 0.1, 0.35), (0.6, 0.1, 0.3), (1.0, 0.4, 0.1), (1.0, 0.8, 0.3), (1.0, 1.0, 0.9))
DEEP = ((0.25, 0.15, 0.45), (0.2, 0.35, 0.6), (0.15, 0.6, 0.55), (0.5, 0.8, 0.3), (0.99, 0.9, 0.15))


def view(eye, target, up, fov):
    return ["--eye=" + eye, "--target=" + target, "--up=" + up, "--fov=" + fov]


BRACKET = view("0.62,-0.42,0.5", "0.1,0.1,0.11", "0,0,1", "26")
# name, file, scalar, camera, the function that VTK draws too, and one with options that its mappers of unstructured grids do not have
SIMULATIONS = [
    ("flow", "tet/post_tet.vtu", "Velocity", view("24,-34,30", "0,0,1.5", "0,0,1", "36"), ramp(COOL_WARM, [[0, 0.15], [0.1, 0.03], [0.4, 0.03], [0.7, 0.1], [1, 1]]),
     dict(ramp(COOL_WARM, [[0, 0]]), isosurfaces=[{"value": 0.45, "opacity": 0.12, "color": [0.7, 0.8, 1]}, {"value": 0.85, "opacity": 0.4, "color": [1, 0.45, 0.3]}]),
     ["--mode", "scale-invariant", "--silhouette", "--light", "0.3,-0.6,1", "--ambient", "0.25", "--slice", "0,0.01,0,0,1,0", "--isolines", "12"] + SMOOTH),
    ("stress", "tet/bracket_appended_compressed.vtu", "sj2p", BRACKET, ramp(DEEP, [[0, 8], [0.2, 25], [0.5, 120], [1, 600]]),
     ramp(DEEP, [[0, 4], [0.12, 10], [0.2, 300], [1, 900]]), ["--smooth-cells", "--light", "0.5,-0.6,1", "--ambient", "0.35"] + SMOOTH),
    ("reservoir", "mixed/UNISIM-II-D.vtu", "BLOCK_K", view("321000,7473200,2200", "314000,7481600,-1850", "0,0,1", "26"),
     ramp(DEEP, [[0, 0.02], [1, 0.02]]), "Spectral",
     ["--scale", "1,1,6", "--direction=-0.5,1,-0.6", "--up", "0,0,1", "--boundary", "--light", "0.6,-0.8,0.6", "--ambient", "0.3"]),
    ("fire", "mixed/fire_ug.vtu", "t", view("8.4,4.4,10.4", "3.2,1.1,1.2", "0,1,0", "36"), ramp(FLAME, [[0, 0], [0.05, 0.15], [0.3, 2], [1, 14]]),
     dict(ramp(FLAME, [[0, 0], [0.05, 0.15], [0.3, 2], [1, 14]]), isosurfaces=[{"value": 0.3, "opacity": 0.5, "color": [1, 0.55, 0.2]}]),
     ["--light", "0.3,1,0.6", "--ambient", "0.4", "--slice", "3,1.25,0.02,0,0,1", "--isolines", "10", "--silhouette"] + SMOOTH),
    ("crash", "mixed/can.vtu", "EQPS", view("-14,18,6", "-3.1,0.6,-16", "0,1,0", "35"), ramp(FLAME, [[0, 3], [0.3, 12], [1, 60]]),
     ramp(FLAME, [[0, 40], [1, 60]]), ["--smooth-cells", "--light", "-0.5,1,0.8", "--ambient", "0.45"] + SMOOTH),
]


def simulations(draw, draw_with_vtk, data):
    """`data(NAME)`: the file, or None where it is not there."""
    for name, path, scalar, camera, function, more, options in SIMULATIONS:
        file = data(path)
        if file is None:
            continue
        draw(f"simulation-{name}", file, function, camera + ["--scalar", scalar])
        draw_with_vtk(f"simulation-{name}-vtk", file, scalar, function, camera)
        own_view = any(option.startswith("--direction") for option in options)
        draw(f"simulation-{name}-more", file, more, ([] if own_view else camera) + ["--scalar", scalar] + options)


ALL = [kraus, ament, marchesin, lecture, hybrid]
