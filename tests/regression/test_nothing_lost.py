#!/usr/bin/python3
"""A run stopped by signals, killed and restarted dozens of times: nothing may differ, nothing may be lost.

Usage: test_nothing_lost.py KOSHI CASE. Exits 1 with a message at the first difference. No life of the run can reach its
end: it is endless until it has been interrupted often enough. Then it ends a thousand steps further on, and so
does a run that was never interrupted. Equal states give equal checkpoint files, byte for byte.
"""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

KOSHI, CASE = (os.path.abspath(argument) for argument in sys.argv[1:3])
KILLS = 30
# A power of two below the stable step: the step is the same, to the last bit, whatever the number of steps.
STEP = 2.0**-24
# Hours of steps. (Above 2^29 the program would round the number, and with it the step.)
ENDLESS = 2**28


def fail(message):
    print("FAILED:", message, flush=True)
    sys.exit(1)


def start(directory, steps, ranks=1):
    """Goes on from the last checkpoint, or starts if there is none yet."""
    settings = {"analysis.time_step": STEP, "analysis.duration": steps * STEP, "analysis.damping": '{kind = "none"}',
                "output.history_every": 16 * STEP}
    arguments = [argument for key, value in settings.items() for argument in ("--set", f"{key}={value}")]
    checkpoint = os.path.join(directory, "checkpoint.h5")
    if os.path.exists(checkpoint):
        arguments += ["--restart", checkpoint]
    return subprocess.Popen([KOSHI, "run", CASE, "--out", directory, "--quiet", "--ranks", str(ranks), *arguments],
                            text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def run(directory, steps, ranks=1):
    process = start(directory, steps, ranks)
    message = process.communicate()[1]
    if process.returncode != 0:
        fail(f"{process.args}: exit code {process.returncode}: {message}")


def wait_for_checkpoint(directory, process):
    """Until the process has written one of its own."""
    checkpoint = os.path.join(directory, "checkpoint.h5")

    def version():
        try:
            status = os.stat(checkpoint)
            return status.st_ino, status.st_mtime_ns
        except FileNotFoundError:  # none yet, or just being renamed
            return None

    before = version()
    while version() in (None, before):
        if process.poll() is not None:
            fail(f"{process.args}: ended by itself with exit code {process.returncode}: {process.stderr.read()}")
        time.sleep(0.005)


def stop(directory, ranks, number):
    """Stops a life by a signal; returns the step it has come to."""
    process = start(directory, ENDLESS, ranks)
    wait_for_checkpoint(directory, process)
    process.send_signal(number)
    message = process.communicate()[1]
    stopped = re.search(r"stopped by a signal at step (\d+) .*--restart", message)
    if process.returncode != 1 or not stopped:
        fail(f"{ranks} ranks, {number.name}: exit code {process.returncode}: {message}")
    if os.path.exists(os.path.join(directory, "checkpoint.h5.part")):
        fail(f"{ranks} ranks, {number.name}: a checkpoint was not written to its end")
    return int(stopped[1])


def survives_signals(directory):
    """Stopped again and again, and continued on another number of ranks."""
    stops = ((1, signal.SIGTERM), (2, signal.SIGINT), (1, signal.SIGINT), (3, signal.SIGTERM))
    steps = [0] + [stop(directory, *how) for how in stops]
    if steps != sorted(set(steps)):
        fail(f"the run does not go on: steps {steps}")
    print(f"stopped {len(stops)} times on 1, 2 and 3 ranks, at steps {steps[1:]}", flush=True)


def survives_kills(directory):
    """SIGKILL at random moments of starting, stepping and writing, whichever they are. A restart checks the whole
    checkpoint it finds."""
    random.seed(1)
    for kill in range(KILLS):
        process = start(directory, ENDLESS)
        # Some at any moment of a life, so that they hit the start as well; most after a step forward.
        if kill % 3:
            wait_for_checkpoint(directory, process)
        time.sleep(random.uniform(0, 0.08))
        process.kill()
        message = process.communicate()[1]
        if process.returncode != -signal.SIGKILL:
            fail(f"restart after {kill} kills: exit code {process.returncode}: {message}")
    print(f"killed {KILLS} times at random moments", flush=True)


def expect_equal(directory, reference):
    """History and last state, to the last bit."""
    for name, least in ("history.csv", 10_000), ("checkpoint.h5", 250_000):
        with open(os.path.join(directory, name), "rb") as a, open(os.path.join(reference, name), "rb") as b:
            got, wanted = a.read(), b.read()
        if len(wanted) < least:
            fail(f"{reference}/{name} holds only {len(wanted)} bytes")
        if got != wanted:
            fail(f"{directory}/{name} ({len(got)} bytes) differs from that of the uninterrupted run ({len(wanted)} bytes)")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    survives_signals("interrupted")
    survives_kills("interrupted")
    last = stop("interrupted", 1, signal.SIGTERM) + 1000
    run("interrupted", last, ranks=2)
    run("whole", last)
    expect_equal("interrupted", "whole")
    print(f"finished step {last} with the same bits")
