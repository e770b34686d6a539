#!/usr/bin/python3
"""Runs of the program stopped by signals, killed and restarted: nothing may differ, nothing may be lost.

Usage: test_nothing_lost.py KOSHI CASE. Exits 1 with a message at the first difference. The case writes a checkpoint
every few hundredths of a second; equal states give equal checkpoint files, byte for byte.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

KOSHI, CASE = (os.path.abspath(argument) for argument in sys.argv[1:3])
KILLS = 30


def fail(message):
    print("FAILED:", message, flush=True)
    sys.exit(1)


def start(directory, *arguments):
    """Goes on from the last checkpoint, or starts if there is none yet."""
    checkpoint = os.path.join(directory, "checkpoint.h5")
    if os.path.exists(checkpoint):
        arguments = (*arguments, "--restart", checkpoint)
    return subprocess.Popen([KOSHI, "run", CASE, "--out", directory, "--quiet", *arguments], text=True,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def run(directory, *arguments):
    process = start(directory, *arguments)
    message = process.communicate()[1]
    if process.returncode != 0:
        fail(f"{process.args}: exit code {process.returncode}: {message}")


def wait_for_checkpoint(directory, process):
    """Until the process has written one of its own."""
    checkpoint = os.path.join(directory, "checkpoint.h5")
    changed = lambda: os.stat(checkpoint).st_mtime_ns if os.path.exists(checkpoint) else 0
    before = changed()
    while process.poll() is None and changed() == before:
        time.sleep(0.005)


def expect_equal(directory, reference):
    """History and last state, to the last bit."""
    for name, least in ("history.csv", 10_000), ("checkpoint.h5", 250_000):
        with open(os.path.join(directory, name), "rb") as a, open(os.path.join(reference, name), "rb") as b:
            got, wanted = a.read(), b.read()
        if len(wanted) < least:
            fail(f"{reference}/{name} holds only {len(wanted)} bytes")
        if got != wanted:
            fail(f"{directory}/{name} differs from that of the uninterrupted run")


def survives_signals():
    """Stopped again and again, and continued on another number of ranks."""
    stops = ((1, signal.SIGTERM), (2, signal.SIGINT), (1, signal.SIGINT), (3, signal.SIGTERM))
    for ranks, number in stops:
        process = start("signals", "--ranks", str(ranks))
        wait_for_checkpoint("signals", process)
        process.send_signal(number)
        message = process.communicate()[1]
        if process.returncode != 1 or "stopped by a signal at step" not in message or "--restart" not in message:
            fail(f"{ranks} ranks, {number.name}: exit code {process.returncode}: {message}")
        if os.path.exists("signals/checkpoint.h5.part"):
            fail(f"{ranks} ranks, {number.name}: a checkpoint was not written to its end")
    run("signals", "--ranks", "2")
    expect_equal("signals", "whole")
    print(f"stopped {len(stops)} times on 1, 2 and 3 ranks and finished with the same bits")


def survives_kills():
    """SIGKILL at random moments of starting, stepping and writing. A restart checks the whole checkpoint it finds."""
    random.seed(1)
    killed = restarts = 0
    while killed < KILLS:
        restarts += os.path.exists("kills/checkpoint.h5")
        process = start("kills")
        # Some at any moment of a life, so that they hit the start as well; most after a step forward.
        if killed % 3:
            wait_for_checkpoint("kills", process)
        time.sleep(random.uniform(0, 0.08))
        process.kill()
        message = process.communicate()[1]
        if process.returncode == -signal.SIGKILL:
            killed += 1
        elif process.returncode == 0:
            expect_equal("kills", "whole")  # it had finished: begin again
            shutil.rmtree("kills")
        else:
            fail(f"restart after {killed} kills: exit code {process.returncode}: {message}")
    if restarts < KILLS // 2:
        fail(f"only {restarts} restarts")
    run("kills")
    expect_equal("kills", "whole")
    print(f"killed {killed} times at random moments and finished with the same bits")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    run("whole")
    survives_signals()
    survives_kills()
