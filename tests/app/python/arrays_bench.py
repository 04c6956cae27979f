"""How long an index of arrays takes, and how much memory, over one of raw files with the same values.

    PYTHONPATH=build/release/python /usr/bin/python3 tests/app/python/arrays_bench.py [EDGE [STEPS [ROUNDS]]]
"""

import json
import os
import subprocess
import sys
import tempfile

import isochron

BUILD = """
import json, time
import numpy as np, xarray, dask, dask.array
import isochron
edge, steps = {edge}, {steps}
names = [f"t{{step:03}}.raw" for step in range(steps)]
read = dask.delayed(lambda name: np.fromfile(name, np.float32).reshape(edge, edge, edge))
lazy = dask.array.stack([dask.array.from_delayed(read(name), (edge,) * 3, np.float32) for name in names])
def resident(what):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(what))
def data():
    if "{kind}" == "numpy":
        return np.stack([np.fromfile(name, np.float32) for name in names]).reshape(steps, edge, edge, edge)
    return lazy if "{kind}" == "dask" else xarray.DataArray(lazy, dims=("time", "z", "y", "x"), name="rho")
if "{kind}" == "raw":
    build = lambda: isochron.build("t*.raw", "o.isochron", dims=(edge,) * 3, type="f32")
else:
    given = data()
    build = lambda: isochron.build(given, "o.isochron")
with open("/proc/self/clear_refs", "w") as refs:
    refs.write("5")  # the peak counts from here
before, began, worked = resident("VmRSS"), time.perf_counter(), time.process_time()
build()
print(json.dumps([time.perf_counter() - began, time.process_time() - worked, (resident("VmHWM") - before) / 1024]))
"""

MAKE = """
import numpy as np
edge, steps = {edge}, {steps}
z, y, x = np.meshgrid(*3 * [np.linspace(-1, 1, edge, dtype=np.float32)], indexing="ij")
noise = np.random.default_rng(1).normal(size=(edge,) * 3).astype(np.float32) * np.float32(1e-3)
for step in range(steps):
    (np.sin(5 * x + 0.1 * step) * np.cos(4 * y) + z * z + np.roll(noise, step)).astype("<f4").tofile(f"t{{step:03}}.raw")
"""


def measured(code, folder, **what):
    package = os.path.dirname(os.path.dirname(os.path.abspath(isochron.__file__)))
    ran = subprocess.run([sys.executable, "-c", code.format(**what)], cwd=folder, check=True, stdout=subprocess.PIPE, text=True,
                         env=os.environ | {"PYTHONPATH": package})
    return json.loads(ran.stdout) if ran.stdout else None


def main(edge=128, steps=64, rounds=3):
    step = 4 * edge**3 / 2**20
    with tempfile.TemporaryDirectory(prefix="arrays-", dir=os.environ.get("TMPDIR")) as folder:
        measured(MAKE, folder, edge=edge, steps=steps)
        kinds = ("raw", "dask", "xarray", "numpy")
        found = {kind: [] for kind in kinds}
        for _ in range(rounds):
            for kind in kinds:
                found[kind].append(measured(BUILD, folder, edge=edge, steps=steps, kind=kind))
    least = {kind: [min(of) for of in zip(*found[kind])] for kind in kinds}
    print(f"{steps} steps of {edge}^3 f32, {step:.0f} MiB each; the least of {rounds}")
    for kind in kinds:
        seconds, worked, memory = least[kind]
        print(f"{kind:8} {seconds:6.2f} s, {seconds / least['raw'][0]:.2f} of raw; processors {worked:5.2f} s, "
              f"{worked / least['raw'][1]:.2f} of raw; {memory:5.0f} MiB more than before, "
              f"{(memory - least['raw'][2]) / step:+.2f} steps over raw")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
