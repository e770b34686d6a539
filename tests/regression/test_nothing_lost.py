#!/usr/bin/python3
"""Runs of the program on several ranks, interrupted, killed and restarted: nothing may differ, nothing may be lost.

Usage: test_nothing_lost.py KOSHI CASE. Exits 1 with a message at the first difference.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

KOSHI, CASE = (os.path.abspath(argument) for argument in sys.argv[1:3])


def fail(message):
    print("FAILED:", message, flush=True)
    sys.exit(1)


def command(directory, *arguments):
    return [KOSHI, "run", CASE, "--out", directory, "--quiet", *arguments]


def run(directory, *arguments):
    done = subprocess.run(command(directory, *arguments), capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{done.args}: exit code {done.returncode}: {done.stderr}")


def state(directory):
    """Every dataset of the last checkpoint."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.ndim >= 3:
            found[name] = item[()]

    with h5py.File(os.path.join(directory, "checkpoint.h5")) as file:
        file.visititems(visit)
    if len(found) < 3:
        fail(f"{directory}: the checkpoint holds only {sorted(found)}")
    return found


def expect_equal(directory, reference):
    with open(os.path.join(directory, "history.csv")) as a, open(os.path.join(reference, "history.csv")) as b:
        rows, expected = a.read().splitlines(), b.read().splitlines()
    if len(expected) < 100:
        fail(f"{reference}: only {len(expected)} rows of history")
    if rows != expected:
        fail(f"{directory}: history.csv differs from {reference}")
    got, wanted = state(directory), state(reference)
    for name, values in wanted.items():
        if not numpy.any(values):
            fail(f"{reference}: {name} is zero everywhere")
        if got[name].tobytes() != values.tobytes():
            fail(f"{directory}: {name} differs from {reference}")


def ranks_agree():
    run("one", "--set", "output.checkpoint_every_wall=\"10 s\"")
    for ranks in (2, 3, 4, 8):
        run(f"ranks{ranks}", "--ranks", str(ranks), "--set", "output.checkpoint_every_wall=\"10 s\"")
        expect_equal(f"ranks{ranks}", "one")
    print("1, 2, 3, 4 and 8 ranks agree bit for bit")


def start(directory, *arguments):
    """Goes on from the last checkpoint, or starts if there is none yet."""
    checkpoint = os.path.join(directory, "checkpoint.h5")
    if os.path.exists(checkpoint):
        arguments = (*arguments, "--restart", checkpoint)
    return subprocess.Popen(command(directory, *arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def survives_signals():
    stops = 0
    for ranks in (1, 2, 1):
        process = start("signals", "--ranks", str(ranks))
        while process.poll() is None and not os.path.exists("signals/checkpoint.h5"):
            time.sleep(0.02)
        time.sleep(0.2)
        process.send_signal(signal.SIGTERM)
        message = process.communicate()[1]
        if ranks == 1 and process.returncode != 0:
            if process.returncode not in (1, -signal.SIGTERM) or (process.returncode == 1 and "--restart" not in message):
                fail(f"SIGTERM: exit code {process.returncode}: {message}")
            stops += process.returncode == 1
    if stops == 0:
        fail("no run was stopped by SIGTERM")
    run("signals", "--restart", "signals/checkpoint.h5", "--ranks", "3")
    expect_equal("signals", "one")
    print("stopped by SIGTERM and restarted on other numbers of ranks: the same bits")


def survives_kills(kills):
    random.seed(1)
    killed = 0
    while killed < kills:
        process = start("kills")
        time.sleep(random.uniform(0.15, 0.6))
        process.kill()
        message = process.communicate()[1]
        if process.returncode == -signal.SIGKILL:
            killed += 1
        elif process.returncode == 0:
            shutil.rmtree("kills")  # it had finished: begin again
        else:
            fail(f"restart after {killed} kills: exit code {process.returncode}: {message}")
        if os.path.exists("kills/checkpoint.h5"):
            state("kills")  # readable and whole
    run("kills", *(["--restart", "kills/checkpoint.h5"] if os.path.exists("kills/checkpoint.h5") else []))
    expect_equal("kills", "one")
    print(f"killed {killed} times at random moments and finished with the same bits")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    ranks_agree()
    survives_signals()
    survives_kills(30)
