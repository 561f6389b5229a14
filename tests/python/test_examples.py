# SPDX-License-Identifier: Apache-2.0
"""Every example runs as it stands and leaves a picture."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from conftest import ROOT

EXAMPLES = sorted((ROOT / "apps/python/examples").glob("*.py"))
ARGUMENTS = {"million_cells.py": ["20"], "against_pyvista.py": ["8", "64"]}
NEEDS = {"pyvista_scene.py": "pyvista", "against_pyvista.py": "pyvista"}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_example(example, tmp_path):
    if example.name in NEEDS:
        pytest.importorskip(NEEDS[example.name])
    command = [sys.executable, str(example), *ARGUMENTS.get(example.name, [])]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, env=os.environ)
    assert done.returncode == 0, done.stderr
    pictures = list(tmp_path.glob("*.png"))
    assert pictures or "rmse" in done.stdout
    assert all(picture.stat().st_size > 1000 for picture in pictures)
