#!/usr/bin/env python3
"""Writes the bundled scenes: each an OBJ and an MTL beside this script.

    assets/generate.py            write all scenes (the same bytes on every run)
    assets/generate.py --check    examine the files that are there, and that they are what this script writes

Needs Python 3.8 and its standard library.
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True

from generator import check, library, small_scenes, two_rooms  # noqa: E402

# Scene, whether it is closed (no light escapes), least number of polygons.
SCENES = [
    (small_scenes.cornell_box, False, 0),
    (small_scenes.two_patches, False, 2),
    (small_scenes.furnace, True, 6),
    (two_rooms.two_rooms, True, 100),
    (library.library, True, 500),
]


def main():
    parser = argparse.ArgumentParser(description="Writes or examines the bundled scenes.")
    parser.add_argument("--check", action="store_true", help="examine the files instead of writing them")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent,
                        help="folder of the files")
    options = parser.parse_args()
    failed = False
    for scene, closed, at_least in SCENES:
        model = scene()
        if not options.check:
            count = model.write(options.out)
            print(f"{model.name}: {count} polygons")
            continue
        problems, figures = check.check(options.out / f"{model.name}.obj", closed, at_least)
        with tempfile.TemporaryDirectory() as fresh:
            model.write(pathlib.Path(fresh))
            for suffix in (".obj", ".mtl"):
                written = (pathlib.Path(fresh) / (model.name + suffix)).read_bytes()
                if written != (options.out / (model.name + suffix)).read_bytes():
                    problems.append(f"{model.name + suffix} is not what this script writes")
        print(f"{model.name}: {figures}")
        for problem in problems:
            print(f"  {problem}")
        failed = failed or bool(problems)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
