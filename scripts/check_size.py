#!/usr/bin/python3
"""Keeps files small: lists those above 400 lines and fails above 450.

usage: check_size.py [ROOT]
"""

import sys
from pathlib import Path

WARN, LIMIT = 400, 450
SUFFIXES = (".h", ".cpp", ".py", ".js", ".ts", ".sh", ".cmake")
TOPS = ("include", "src", "apps", "python", "bench", "tests", "scripts", "cmake", "report", "docs", "examples")
SKIPPED = ("node_modules", "dist", "build")

# File -> why it may be longer.
EXCEPTIONS = {}


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    files = [f for top in TOPS for f in sorted((root / top).rglob("*")) if f.suffix in SUFFIXES]
    files = [f for f in files if not any(part in SKIPPED for part in f.relative_to(root).parts)]
    failed = 0
    for file in files:
        path = file.relative_to(root).as_posix()
        lines = len(file.read_text().splitlines())
        if lines > LIMIT and path not in EXCEPTIONS:
            print(f"{path}:{lines}: error: longer than {LIMIT} lines; split it by concept")
            failed += 1
        elif lines > WARN:
            print(f"{path}:{lines}: longer than {WARN} lines {EXCEPTIONS.get(path, '')}".rstrip())
    print(f"check_size: {len(files)} files, {failed} too long")
    return 1 if failed or not files else 0


if __name__ == "__main__":
    sys.exit(main())
