# SPDX-License-Identifier: Apache-2.0
"""Several threads, signals, forks, and the end of the interpreter."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import tetralux

SIZE = (96, 72)
EYES = [(2 + 0.3 * i, 1.4 - 0.2 * i, 2.3) for i in range(8)]


def test_four_threads_draw_one_mesh(bucky):
    expected = [tetralux.render(bucky, eye=eye, size=SIZE).rgba for eye in EYES]
    renderers = threading.local()

    def draw(eye):
        if not hasattr(renderers, "own"):
            renderers.own = tetralux.Renderer(bucky, size=SIZE)
        return renderers.own.render(eye=eye).rgba

    with ThreadPoolExecutor(4) as pool:
        for drawn, right in zip(pool.map(draw, EYES * 6), expected * 6):
            np.testing.assert_array_equal(drawn, right)


def test_four_threads_share_one_renderer(bucky):
    renderer = tetralux.Renderer(bucky, size=SIZE)
    expected = [renderer.render(eye=eye).rgba for eye in EYES]
    with ThreadPoolExecutor(4) as pool:
        for drawn, right in zip(pool.map(lambda eye: renderer.render(eye=eye).rgba, EYES * 4), expected * 4):
            np.testing.assert_array_equal(drawn, right)


def test_the_lock_is_released_while_drawing(bucky):
    renderer = tetralux.Renderer(bucky, size=(400, 300), engine="reference", threads=1)
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    start = time.perf_counter()
    renderer.render()
    spent = time.perf_counter() - start
    stop.set()
    other.join()
    assert counted[0] > 100 * min(spent, 1.0)


def busy_renderer(n=48):
    """One that takes a second and more for a frame."""
    return tetralux.Renderer(f"bucky:{n}", size=(600, 450), engine="reference", threads=1)


def seconds_to_control_c(renderer, after):
    """How long it takes from the signal until render has raised."""
    main, sent = threading.get_ident(), []

    def interrupt():
        time.sleep(after)
        sent.append(time.perf_counter())
        signal.pthread_kill(main, signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        renderer.render()
    return time.perf_counter() - sent[0]


def test_control_c_ends_a_frame_in_50_ms():
    renderer = busy_renderer()
    # a busy machine may be late by itself: the best of some
    assert min(seconds_to_control_c(renderer, after) for after in (0.7, 0.3, 0.5)) < 0.05
    assert tetralux.Renderer("bucky:8", size=(8, 8)).render().rgba.shape == (8, 8, 4)
    assert renderer.render(size=(16, 12)).rgba.shape == (12, 16, 4)  # it is ready for the next one


def test_cancel_from_another_thread():
    renderer = busy_renderer()
    threading.Timer(0.5, renderer.cancel).start()
    start = time.perf_counter()
    with pytest.raises(tetralux.CancelledError):
        renderer.render()
    assert 0.4 < time.perf_counter() - start < 1.5
    assert renderer.render(size=(16, 12)).rgba.shape == (12, 16, 4)


def run(code: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=120)


def test_the_interpreter_ends_whatever_is_going_on():
    done = run(
        """
        import threading, tetralux
        kept = tetralux.Renderer("bucky:16", size=(64, 48))
        kept.render()
        slow = tetralux.Renderer("bucky:32", size=(400, 300), engine="reference", threads=1)
        threading.Thread(target=slow.render, daemon=True).start()
        import time; time.sleep(0.5)
        """
    )
    assert (done.returncode, done.stdout) == (0, "")
    assert "Fatal" not in done.stderr  # the thread's own end, CancelledError, may be told, as far as the interpreter gets with it


def test_nothing_is_printed():
    done = run("import tetralux; r = tetralux.Renderer('bucky:8', size=(16, 12)); r.render(); r.verify(10)")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_forked_process_is_told():
    done = run(
        """
        import os, tetralux
        renderer = tetralux.Renderer("bucky:8", size=(16, 12))
        renderer.render()
        child = os.fork()
        if child == 0:
            try:
                renderer.render()
            except tetralux.Error as error:
                os._exit(7 if "forked" in str(error) else 8)
            os._exit(9)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
        """
    )
    assert (done.returncode, done.stderr) == (0, "")
