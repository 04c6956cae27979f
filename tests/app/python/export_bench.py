"""Steps of the demo's sphere as binary PLY, by the program and by VTK's contour and writer: medians in turn.

    /usr/bin/python3 tests/app/python/export_bench.py build/release/isochron [PROGRAM...]

The program's time is that of its whole process. VTK's is that of its filters alone, once with reading the steps from
their files and once with all steps in memory. Several programs are measured in turn, too.
"""

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import vtk

STEPS, ISOVALUE, ROUNDS = 55, 100, 15


def by_program(program):
    subprocess.run([program, "export", "run.isochron", "--isovalue", str(ISOVALUE), "--format", "ply", "-o", "out/"],
                   check=True, stdout=subprocess.DEVNULL)


def by_vtk(source_of):
    contour, writer = vtk.vtkFlyingEdges3D(), vtk.vtkPLYWriter()
    contour.SetValue(0, ISOVALUE)
    writer.SetInputConnection(contour.GetOutputPort())
    writer.SetFileTypeToBinary()
    for step in range(STEPS):
        source_of(contour, step)
        writer.SetFileName(f"out/run_{step:04}.ply")
        writer.Write()


def main(programs):
    programs = [os.path.abspath(program) for program in programs]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for typed in (["generate", "sphere", "--steps", str(STEPS), "-o", "run"], ["build", "run", "-o", "run.isochron"]):
            subprocess.run([programs[0], *typed], check=True, stdout=subprocess.DEVNULL)
        files = [os.path.join("run", name) for name in sorted(os.listdir("run")) if name.endswith(".vti")]
        assert len(files) == STEPS, files
        reader, images = vtk.vtkXMLImageDataReader(), []
        for file in files:
            reader.SetFileName(file)
            reader.Update()
            image = vtk.vtkImageData()
            image.DeepCopy(reader.GetOutput())
            images.append(image)

        def read(contour, step):
            reader.SetFileName(files[step])
            contour.SetInputConnection(reader.GetOutputPort())

        ways = {f"{i + 1} {program}": (lambda of=program: by_program(of)) for i, program in enumerate(programs)}
        ways["VTK with reading"] = lambda: by_vtk(read)
        ways["VTK with its data in memory"] = lambda: by_vtk(lambda contour, step: contour.SetInputData(images[step]))
        times = {way: [] for way in ways}
        busy = {way: [] for way in ways}
        for _ in range(ROUNDS):
            for way, run in ways.items():
                shutil.rmtree("out", ignore_errors=True)
                os.mkdir("out")
                before = [resource.getrusage(of) for of in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
                started = time.perf_counter()
                run()
                times[way].append(time.perf_counter() - started)
                after = [resource.getrusage(of) for of in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
                busy[way].append(sum(b.ru_utime + b.ru_stime - a.ru_utime - a.ru_stime for a, b in zip(before, after)))
                assert len([name for name in os.listdir("out") if name.endswith(".ply")]) == STEPS
        median = {way: statistics.median(of) for way, of in times.items()}
        for way, of in times.items():
            print(f"{1e3 * median[way]:7.1f} ms ({1e3 * min(of):.1f} to {1e3 * max(of):.1f}), "
                  f"processors {1e3 * statistics.median(busy[way]):.0f} ms: {way}")
        for way in list(ways)[:len(programs)]:
            print(f"{median['VTK with reading'] / median[way]:.2f} times as fast as VTK with reading, "
                  f"{median['VTK with its data in memory'] / median[way]:.2f} as VTK with its data in memory: {way}")
        print("load", *os.getloadavg())


if __name__ == "__main__":
    main(sys.argv[1:])
