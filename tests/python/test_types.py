# SPDX-License-Identifier: Apache-2.0
"""Types: the package by mypy, the compiled part's stubs against the module."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from conftest import ROOT

pytest.importorskip("mypy")


def run(folder, *command: str) -> None:
    source = {**os.environ, "MYPYPATH": str(ROOT / "apps/python"), "MYPY_CACHE_DIR": str(folder)}
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, env=source)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy(tmp_path):
    run(tmp_path, "mypy", "--config-file", "pyproject.toml", "-p", "tetralux")


def test_stubs_are_those_of_the_module(tmp_path):
    run(tmp_path, "mypy.stubtest", "tetralux._core", "--ignore-missing-stub", "--mypy-config-file", "pyproject.toml")
