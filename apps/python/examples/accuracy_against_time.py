# SPDX-License-Identifier: Apache-2.0
"""What each engine takes, and how far its picture is from the exact one."""

import tetralux

mesh = tetralux.read("bucky:32")
for engine, available, why_not in tetralux.engines():
    if not available:
        print(f"{engine:10} not here: {why_not}")
        continue
    size = (128, 128) if engine == "reference" else (512, 512)
    renderer = tetralux.Renderer(mesh, transfer_function="viridis", size=size, engine=engine)
    renderer.render()  # the first frame finds out about the mesh
    took = min(renderer.render(eye=(1.9, 1.4, 2.3 + 0.01 * i)).report["milliseconds"] for i in range(3))
    found = renderer.verify(1000)
    print(f"{engine:10} {size[0]}x{size[1]}  {took:7.1f} ms  rmse {found['rmse']:.1e}  max {found['max']:.1e}")
