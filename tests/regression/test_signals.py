#!/usr/bin/python3
"""Every signal that asks for a stop, sent to runs that would never end: motion keeps a checkpoint, equilibrium says so.

Usage: test_signals.py KOSHI CASE. Exits 1 with a message at the first wrong answer. A signal is sent when the run has
shown that it is at work, by its first line of progress or by a new checkpoint; nothing waits for a clock.
"""

import os
import signal
import subprocess
import sys
import tempfile

KOSHI, CASE = (os.path.abspath(argument) for argument in sys.argv[1:3])
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU, signal.SIGHUP)

MOTION = ("--set", "analysis.duration=1e4", "--set", 'analysis.damping={kind = "none"}')
# Steps so small that the residual never falls.
EQUILIBRIUM = ("--set", 'analysis={type = "static"}', "--", "-ksp_type", "richardson",
               "-ksp_richardson_scale", "1e-15", "-ksp_max_it", "1000000000")


def fail(message):
    print("FAILED:", message, flush=True)
    sys.exit(1)


def start(arguments, ranks, **options):
    own = arguments[: arguments.index("--")] if "--" in arguments else arguments
    petsc = arguments[len(own) :]
    process = subprocess.Popen([KOSHI, "run", CASE, "--out", "out", "--ranks", str(ranks), *own, *petsc], text=True,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)
    said = ""
    for line in process.stderr:
        said += line
        if " step 10," in line or " iteration 0," in line:
            return process
    fail(f"{process.args} does not start: {said}")


def stop(process, number, wanted):
    process.send_signal(number)
    message = process.communicate()[1]
    if process.returncode != 1 or wanted not in message:
        fail(f"{process.args}, {number.name}: exit code {process.returncode}: {message}")


def every_signal():
    stopped = 0
    for number in SIGNALS:
        for ranks in 1, 2:
            stop(start(MOTION, ranks), number, "stopped by a signal at step")
            if not os.path.exists("out/checkpoint.h5") or os.path.exists("out/checkpoint.h5.part"):
                fail(f"{ranks} ranks, {number.name}: no whole checkpoint")
            os.remove("out/checkpoint.h5")
            stopped += 1
    for number, ranks in (*((number, 1) for number in SIGNALS), (signal.SIGUSR2, 2)):
        stop(start(EQUILIBRIUM, ranks), number, "a static analysis keeps no checkpoint: run it again")
        if os.path.exists("out/checkpoint.h5"):
            fail(f"{ranks} ranks, {number.name}: a static analysis that was stopped left a checkpoint")
        stopped += 1
    print(f"stopped {stopped} times")


def ignored_hangup():
    """Under nohup the end of a terminal does not end the run: it writes on."""
    process = start((*MOTION, "--set", "output.checkpoint_every=1e-6"), 1,
                    preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    process.send_signal(signal.SIGHUP)
    seen = set()
    while len(seen) < 3 and process.poll() is None:
        try:
            seen.add(os.stat("out/checkpoint.h5").st_ino)
        except FileNotFoundError:
            pass
    stop(process, signal.SIGTERM, "stopped by a signal at step")
    print("goes on under nohup")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    every_signal()
    ignored_hangup()
