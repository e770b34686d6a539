#!/usr/bin/python3
"""Random damages of well-formed and hostile files, fed to every reader under the sanitizers.

usage: damage.py [COUNT] [TARGET ...]     COUNT damages per format, 10000 by default; build the preset "fuzz" first

Each damage is one to four changes of a file of tests/fuzz/corpus: bytes changed, cut out, doubled or put in, numbers of
the text replaced, the end cut off. A signal, a sanitizer's finding or ten seconds without an answer ends the script with
exit code 1, and the file stays in out/damage. The same COUNT gives the same damages.
"""

import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NUMBERS = [b"0", b"-1", b"1", b"3", b"255", b"65536", b"2147483648", b"4294967296", b"-9223372036854775808",
           b"18446744073709551616", b"1e308", b"nan", b"0x7f", b"%n%s"]


def damaged(rng, data):
    """The bytes with one to four random changes."""
    for _ in range(rng.randint(1, 4)):
        at, length = rng.randrange(len(data) + 1), rng.choice([1, 1, 2, 4, 8, 64])
        kind = rng.randrange(6)
        if kind == 0:
            data = data[:at] + bytes(rng.randrange(256) for _ in range(length)) + data[at + length:]
        elif kind == 1:
            data = data[:at] + data[at + length:]
        elif kind == 2:
            data = data[:at] + data[at:at + length] + data[at:]
        elif kind == 3:
            data = data[:at] + bytes(rng.choice([0, 10, 32, 127, 255]) for _ in range(length)) + data[at:]
        elif kind == 4 and (numbers := list(re.finditer(rb"-?\d+", data[:4096]))):
            number = rng.choice(numbers)
            data = data[:number.start()] + rng.choice(NUMBERS) + data[number.end():]
        else:
            data = data[:at]
    return data


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10000
    targets = sys.argv[2:] or sorted(path.stem[5:] for path in (ROOT / "tests/fuzz").glob("fuzz_*.cpp")
                                     if (ROOT / "build/fuzz/tests/fuzz" / path.stem).exists())
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
    kept = ROOT / "out/damage"
    kept.mkdir(parents=True, exist_ok=True)
    for target in targets:
        wholes = [path.read_bytes() for path in sorted((ROOT / "tests/fuzz/corpus" / target).iterdir())]
        rng = random.Random(f"{target} {count}")
        with tempfile.TemporaryDirectory() as folder:
            for number in range(count):
                Path(folder, f"{number:06}").write_bytes(damaged(rng, rng.choice(wholes)))
            program = ROOT / f"build/fuzz/tests/fuzz/fuzz_{target}"
            command = [program, "-runs=0", "-timeout=10", "-rss_limit_mb=4096", f"-artifact_prefix={kept}/{target}-", folder]
            result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            sys.exit(f"{result.stderr[-4000:]}\n{target}: failed; the file is in {kept}")
        # What libFuzzer has run when it is through with the folder: empty files are one.
        done, cover = re.search(r"#(\d+)\s+INITED cov: (\d+)", result.stderr).groups()
        print(f"{target}: {done} damages of {len(wholes)} files, no signal, no hang; {cover} edges covered", flush=True)


if __name__ == "__main__":
    main()
