#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""structure_scores.py PROGRAM FOLDER: the structure score MS-HWSD (tetralux compare --structure) of Ward's and
Lafortune's highlights at gamma 0, 10 and 60, each lobe against itself at gamma 0, on the Marschner-Lobb signal, an
ellipsoid and a cylinder. Extinction is normalized here, so the ellipsoid's scores differ from those of
projection/modes.md.
"""
import json
import math
import os
import subprocess
import sys

from check_scattering import grid, write_vtu

SIZE = "128x128"
# name: axes of the level sets, view, light, share of the range at which extinction begins, radius of neighbourhoods
SOLID = (["--eye", "3.5,-1.5,1", "--up", "0,0,1"], "1,1,-0.2", 0.7, 5)
SHAPES = {"Marschner–Lobb": (None, ["--eye", "2.6,1.9,4.2", "--up", "0,0,1"], "1,1,2", 0.5, 4),
          "ellipsoid": ((0.45, 0.45, 0.9), *SOLID), "cylinder": ((0.4, 0.4, 1e9), *SOLID)}
LOBES = (("ward", 0.2), ("ward", 0.05), ("lafortune", 10), ("lafortune", 30))


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    transfer, lighting, kept = (os.path.join(folder, name) for name in ("transfer.json", "lighting.json", "kept.vtu"))

    def run(*words):
        return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout

    print("| field | highlight | k_s | γ = 0 | γ = 10 | γ = 60 |\n| --- | --- | --- | --- | --- | --- |")
    for name, (axes, view, light, share, radius) in SHAPES.items():
        source = "marschner-lobb:41"
        if axes:
            source = os.path.join(folder, "shape.vtu")
            write_vtu(source, grid(33, -1.0, 1.0, lambda p: 1 - math.sqrt(sum((x / a) ** 2 for x, a in zip(p, axes)))))
        with open(transfer, "w") as out:
            json.dump({"normalized": True, "color": [[0, 0.75, 0.6, 0.45]], "extinction": [[share, 0], [share + 0.03, 60]]}, out)
        common = ["--tf", transfer, "--size", SIZE, "--quiet", "--normals", "smooth", "--no-transmission", f"--light={light}", *view]
        unlit, *lit = (os.path.join(folder, f"{which}.exr") for which in ("none", 0, 10, 60))
        run("render", source, "-o", unlit, *common, "--reflectance", "none", "--anisotropy", f"radius={radius}", "--keep-anisotropy", kept)
        for specular in (1, 16):
            with open(lighting, "w") as out:
                json.dump({"material": {"specular": specular}}, out)
            for lobe, kappa in LOBES:
                for gamma, picture in zip((0, 10, 60), lit):
                    run("render", kept, "-o", picture, "--lighting", lighting, *common, "--reflectance", lobe, "--anisotropy", f"gamma={gamma},kappa={kappa}")
                scores = json.loads(run("compare", lit[0], lit[1], "--structure", unlit, "--json"))["structure"]
                scores += json.loads(run("compare", lit[0], lit[2], "--structure", unlit, "--json"))["structure"][1:]
                print(f"| {name} | {lobe}, κ = {kappa} | {specular} | " + " | ".join("%.4f" % s for s in scores) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
