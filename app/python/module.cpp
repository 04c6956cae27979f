// The Python module isochron._native: what isochron/__init__.py is made of.
#include "app/python/runs.h"

#include "index/error.h"
#include "index/file/named_index.h"
#include "index/system/module.h"
#include "version_number.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

namespace py = pybind11;
using Unlocked = py::call_guard<py::gil_scoped_release>;

/// An array that owns the vector's memory, so that nothing is copied.
template <class T>
py::array owned(std::vector<T>&& values, const std::vector<py::ssize_t>& shape,
                const py::dtype& type = py::dtype::of<T>()) {
    auto* const kept = new std::vector<T>(std::move(values));
    const py::capsule owner(kept, [](void* of) { delete static_cast<std::vector<T>*>(of); });
    return py::array(type, shape, kept->data(), owner);
}

py::array frozen(py::array array) {
    array.attr("flags").attr("writeable") = false;
    return array;
}

py::array flat(std::vector<std::uint32_t>&& numbers) {
    const auto count = static_cast<py::ssize_t>(numbers.size());
    return frozen(owned(std::move(numbers), {count}));
}

/// Runs searches without the interpreter's lock.
template <class F>
auto unlocked(F&& f) {
    const py::gil_scoped_release release;
    return f();
}

py::array cells(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue) {
    CellNumbers found = unlocked([&] { return array.cells({step, fraction}, isovalue); });
    if (!found.are_wide)
        return flat(std::move(found.narrow));
    const auto count = static_cast<py::ssize_t>(found.wide.size());
    return frozen(owned(std::move(found.wide), {count}));
}

py::tuple change(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue,
                 std::int64_t to_step, std::int64_t to_fraction, double to_isovalue) {
    CellDifference found = unlocked([&] {
        return array.change({step, fraction}, isovalue, {to_step, to_fraction}, to_isovalue);
    });
    return py::make_tuple(flat(std::move(found.added)), flat(std::move(found.removed)));
}

template <class Number>
py::tuple as_tuple(Triangles<Number>&& mesh) {
    const auto points = static_cast<py::ssize_t>(mesh.points.size() / 3);
    const auto faces = static_cast<py::ssize_t>(mesh.faces.size() / 3);
    return py::make_tuple(owned(std::move(mesh.points), {points, 3}),
                          owned(std::move(mesh.faces), {faces, 3}));
}

py::tuple mesh(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue,
               bool absolute) {
    if (absolute)
        return as_tuple(unlocked([&] { return array.mesh({step, fraction}, isovalue); }));
    return as_tuple(unlocked([&] { return array.mesh_from_origin({step, fraction}, isovalue); }));
}

py::dtype type_of(const RunArray& array) {
    return index::visit_value_type(array.file().info().type, [](auto type) -> py::dtype {
        return py::dtype::of<typename decltype(type)::type>();
    });
}

/// Stored values of a step, or scaled ones between two.
py::array values(const RunArray& array, std::int64_t step, std::int64_t fraction, const Box& box) {
    std::vector<py::ssize_t> shape;
    for (const auto& [first, end] : box)
        shape.push_back(static_cast<py::ssize_t>(end) - first);
    if (fraction == 0)
        return owned(unlocked([&] { return array.values({step, 0}, box); }), shape, type_of(array));
    return owned(unlocked([&] { return array.blended_values({step, fraction}, box); }), shape,
                 py::dtype::of<double>());
}

py::object read_bytes(const RunArray& array) {
    return py::int_(array.file().reading().bytes);
}

/// Everything that an array says of itself, by name.
py::dict description(const RunArray& array) {
    const index::SeriesInfo& info = array.file().info();
    const index::Grid& grid = info.grid;
    py::list axes, direction;
    for (int axis = 2; axis >= 0; --axis) {
        std::vector<double> distances;
        for (std::uint32_t vertex = 0; vertex < grid.vertices[axis]; ++vertex)
            distances.push_back(grid.distance(axis, vertex));
        const auto count = static_cast<py::ssize_t>(distances.size());
        axes.append(frozen(owned(std::move(distances), {count})));
    }
    for (int row = 0; row < 3; ++row)
        direction.append(
            py::make_tuple(grid.direction[0][row], grid.direction[1][row], grid.direction[2][row]));
    std::vector<double> times = info.times;
    const auto steps = static_cast<py::ssize_t>(times.size());
    py::dict all;
    all["array"] = info.array;
    all["times"] = frozen(owned(std::move(times), {steps}));
    all["unit"] = info.value_unit;
    all["length_unit"] = info.length_unit;
    all["time_unit"] = info.time_unit;
    all["shape"] = py::make_tuple(steps, grid.vertices[2], grid.vertices[1], grid.vertices[0]);
    all["spacing"] = py::make_tuple(grid.spacing.z, grid.spacing.y, grid.spacing.x);
    all["origin"] = py::make_tuple(grid.origin.x, grid.origin.y, grid.origin.z);
    all["direction"] = py::tuple(direction);
    all["distances"] = py::tuple(axes);
    all["dtype"] = type_of(array);
    all["slope"] = info.scaling.slope;
    all["intercept"] = info.scaling.intercept;
    all["range"] = py::make_tuple(array.file().stats().low, array.file().stats().high);
    all["notes"] = py::tuple(py::cast(info.notes));
    return all;
}

void build(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out,
           const std::vector<std::string>& arrays, const std::optional<std::string>& component,
           const py::object& progress) {
    const index::Progress report = [&](std::string_view phase, double fraction) {
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) // Ctrl-C ends the build
            throw py::error_already_set();
        if (!progress.is_none())
            progress(std::string(phase), fraction);
    };
    const py::gil_scoped_release release;
    build_run(files, out, arrays, component, report);
}

std::vector<std::string> names_of(const OpenRun& run) {
    return index::array_names(run.file());
}

} // namespace

PYBIND11_MODULE(_native, module) {
    using namespace py::literals;
    module.attr("__version__") = ISOCHRON_VERSION;
    py::register_exception<index::Error>(module, "Error");
    module.attr("FROM_INSTALLED") = ISOCHRON_FROM_INSTALLED;
    module.attr("FROM_BUILT") = ISOCHRON_FROM_BUILT;
    module.def("set_program_folder", &index::set_program_folder, "folder"_a);
    module.def("build", &build, "files"_a, "out"_a, "arrays"_a, "component"_a, "progress"_a);

    py::class_<RunArray>(module, "RunArray")
        .def("cells", &cells, "step"_a, "fraction"_a, "isovalue"_a)
        .def("change", &change, "step"_a, "fraction"_a, "isovalue"_a, "to_step"_a, "to_fraction"_a,
             "to_isovalue"_a)
        .def("mesh", &mesh, "step"_a, "fraction"_a, "isovalue"_a, "absolute"_a)
        .def("values", &values, "step"_a, "fraction"_a, "box"_a)
        .def("description", &description)
        .def("read_bytes", &read_bytes);
    py::class_<OpenRun, std::shared_ptr<OpenRun>>(module, "OpenRun")
        .def(py::init<const std::filesystem::path&>(), "path"_a, Unlocked())
        .def("array", &OpenRun::array, "name"_a, py::return_value_policy::reference_internal)
        .def("names", &names_of)
        .def("lost", &OpenRun::lost);
}

} // namespace isochron::app
