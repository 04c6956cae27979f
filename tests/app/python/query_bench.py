"""A query from Python beside the same search in the program: medians in turn, and their ratio.

    PYTHONPATH=build/release/python python3 tests/app/python/query_bench.py run.isochron 0.5 7
"""

import json
import os
import statistics
import subprocess
import sys
import time

import isochron

ROUNDS, REPEATS = 5, 200


def program_ms(program, name, isovalue, step):
    ran = subprocess.run(
        [program, "query", name, "--isovalue", str(isovalue), "--step", str(step), "--repeat", str(REPEATS), "--json"],
        capture_output=True,
        check=True,
    )
    return json.loads(ran.stdout)["search_ms"]


def python_ms(run, isovalue, step):
    run.cells(isovalue, step)
    times = []
    for _ in range(REPEATS):
        started = time.perf_counter()
        run.cells(isovalue, step)
        times.append(1e3 * (time.perf_counter() - started))
    return statistics.median(times)


def main(name, isovalue, step):
    folder = os.path.dirname(os.path.abspath(isochron.__file__))
    program = os.environ.get("ISOCHRON_PROGRAM", os.path.join(folder, "../../isochron"))
    run = isochron.open(name)
    rounds = [(program_ms(program, name, isovalue, step), python_ms(run, isovalue, step)) for _ in range(ROUNDS)]
    of_program, of_python = (statistics.median(times) for times in zip(*rounds))
    print(
        f"{run.cells(isovalue, step).size} cells: program {of_program:.4f} ms, Python {of_python:.4f} ms, "
        f"ratio {of_python / of_program:.3f}, {1e3 * (of_python - of_program):.1f} us more"
    )


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), int(sys.argv[3]))
