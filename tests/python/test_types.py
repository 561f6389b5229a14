# SPDX-License-Identifier: Apache-2.0
"""Types: the package by mypy, the compiled part's stubs against the module."""

from __future__ import annotations

import ast
import os
import re
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


def test_the_package_has_what_its_types_say(tmp_path):
    allowed = tmp_path / "allowed"
    allowed.write_text(r"tetralux\._core\..*")  # of nanobind: no functions of Python's kind; below
    run(tmp_path, "mypy.stubtest", "tetralux", "--allowlist", str(allowed), "--mypy-config-file", "pyproject.toml")


def arguments_of(function) -> list[str]:
    """Names of the arguments of a function of nanobind."""
    text = re.sub(r"\[[^\[\]]*\]", "", function.__nb_signature__[0][0].replace("'", ""))
    while (shorter := re.sub(r"\[[^\[\]]*\]", "", text)) != text:
        text = shorter
    return re.findall(r"[(,] *(\w+)", re.sub(r"->.*", "", text))


def test_stubs_are_those_of_the_module():
    """The same names with the same arguments."""
    import tetralux._core as core

    tree = ast.parse((ROOT / "apps/python/tetralux/_core.pyi").read_text())

    def compare(body, owner, where):
        stubs = {node.name: node for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        there = {name for name in vars(owner) if not name.startswith("_")}
        assert {name for name in stubs if not name.startswith("_")} == there, where
        for name, node in stubs.items():
            if isinstance(node, ast.ClassDef):
                compare(node.body, getattr(owner, name), name)
                continue
            member = getattr(owner, name)
            if not node.decorator_list and not name.startswith("_"):
                assert [a.arg for a in node.args.args] == arguments_of(member), f"{where}.{name}"

    compare(tree.body, core, "_core")
