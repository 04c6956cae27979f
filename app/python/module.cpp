// The Python module isochron._native: what isochron/__init__.py is made of.
#include "app/python/runs.h"

#include "app/command_line/command_line.h"
#include "index/file/named_index.h"
#include "index/interrupted.h"
#include "index/missing_file.h"
#include "index/system/links/link.h"
#include "index/system/module.h"
#include "index/volume/time_unit.h"
#include "version_number.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <tuple>
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

py::array cells(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue,
                std::size_t level) {
    CellNumbers found = unlocked([&] { return array.cells({step, fraction}, isovalue, level); });
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
py::tuple as_tuple(Triangles<Number>&& mesh, const WishedOfMesh& wished) {
    const auto points = static_cast<py::ssize_t>(mesh.points.size() / 3);
    const auto faces = static_cast<py::ssize_t>(mesh.faces.size() / 3);
    py::object normals = py::none(), values = py::none();
    if (wished.normals)
        normals = owned(std::move(mesh.normals), {points, 3});
    if (wished.values)
        values = owned(std::move(mesh.values), {points});
    return py::make_tuple(owned(std::move(mesh.points), {points, 3}),
                          owned(std::move(mesh.faces), {faces, 3}), normals, values);
}

py::tuple mesh(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue,
               bool absolute, std::size_t level, bool normals,
               const std::optional<std::string>& values, std::uint32_t dust) {
    const WishedOfMesh wished{normals, values, dust};
    const RunArray::AskedInstant at{step, fraction};
    if (absolute)
        return as_tuple(unlocked([&] { return array.mesh(at, isovalue, level, wished); }), wished);
    return as_tuple(unlocked([&] { return array.mesh_from_origin(at, isovalue, level, wished); }),
                    wished);
}

/// The step at which each cell is first active, and the fraction, or none.
py::tuple first_crossings(const RunArray& array, double isovalue, bool blended) {
    index::FirstCrossings found =
        unlocked([&] { return array.first_crossings(isovalue, blended); });
    const auto cells = static_cast<py::ssize_t>(found.steps.size());
    py::object fractions = py::none();
    if (found.blended())
        fractions = owned(std::move(found.fractions), {cells});
    return py::make_tuple(owned(std::move(found.steps), {cells}), fractions);
}

py::dtype dtype_of(index::ValueType type) {
    return index::visit_value_type(
        type, [](auto of) -> py::dtype { return py::dtype::of<typename decltype(of)::type>(); });
}

py::dtype type_of(const RunArray& array) {
    return dtype_of(array.file().info().type);
}

/// Stored values of a step, or scaled ones between two.
py::array values(const RunArray& array, std::int64_t step, std::int64_t fraction, const Box& box,
                 std::size_t level) {
    std::vector<py::ssize_t> shape;
    for (const auto& [first, end] : box)
        shape.push_back(static_cast<py::ssize_t>(end) - first);
    if (fraction == 0)
        return owned(unlocked([&] {
                         return array.values({step, 0}, box, level);
                     }),
                     shape, type_of(array));
    return owned(unlocked([&] {
                     return array.blended_values({step, fraction}, box, level);
                 }),
                 shape, py::dtype::of<double>());
}

py::object read_bytes(const RunArray& array) {
    return py::int_(array.file().reading().bytes);
}

/// Distances of the vertices from the first one along z, y and x.
py::tuple distances_of(const index::Grid& grid) {
    py::list axes;
    for (int axis = 2; axis >= 0; --axis) {
        std::vector<double> distances;
        for (std::uint32_t vertex = 0; vertex < grid.vertices[axis]; ++vertex)
            distances.push_back(grid.distance(axis, vertex));
        const auto count = static_cast<py::ssize_t>(distances.size());
        axes.append(frozen(owned(std::move(distances), {count})));
    }
    return axes;
}

/// Everything that an array says of itself, by name.
py::dict description(const RunArray& array) {
    constexpr std::array<const char*, 4> kAnatomies{"", "RAS", "LPS", "ENU"};
    const index::SeriesInfo& info = array.file().info();
    const index::Grid& grid = info.grid;
    py::list direction, levels;
    for (std::size_t level = 0; level < array.file().detail_levels(); ++level)
        levels.append(distances_of(array.file().chunks(level).info().grid));
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
    all["levels"] = py::tuple(levels);
    all["anatomy"] = kAnatomies[static_cast<std::size_t>(info.anatomy)];
    all["axis_names"] = py::make_tuple(info.axis_names[0], info.axis_names[1], info.axis_names[2]);
    all["dtype"] = type_of(array);
    all["slope"] = info.scaling.slope;
    all["intercept"] = info.scaling.intercept;
    all["range"] = py::make_tuple(array.file().stats().low, array.file().stats().high);
    all["notes"] = py::tuple(py::cast(info.notes));
    return all;
}

/// What Python gives of its arrays: a file that describes them, the function that yields the pieces
/// of a step, and their name.
using GivenArrays = std::tuple<std::filesystem::path, py::function, std::string>;

std::vector<std::string>
build(const std::vector<std::string>& files, const std::filesystem::path& out,
      const std::vector<std::string>& words, const std::vector<double>& times,
      const std::optional<GivenArrays>& given, const py::object& progress) {
    const index::Progress report = [&](std::string_view phase, double fraction) {
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) // Ctrl-C ends the build
            throw py::error_already_set();
        if (!progress.is_none())
            progress(std::string(phase), fraction);
    };
    std::exception_ptr raised; // what the arrays raise is nothing about a file
    PythonArrays arrays;
    if (given) {
        const py::function& pieces = std::get<1>(*given);
        arrays.description = std::get<0>(*given);
        arrays.name = std::get<2>(*given);
        arrays.read = [&](const std::string& array, std::size_t step, index::ValueType type,
                          const index::TakePiece& take) {
            const py::gil_scoped_acquire acquire;
            try {
                for (const py::handle piece : pieces(array, step, dtype_of(type))) {
                    const auto values = py::cast<py::array>(piece);
                    const std::span bytes(static_cast<const std::byte*>(values.data()),
                                          static_cast<std::size_t>(values.nbytes()));
                    const py::gil_scoped_release release;
                    take(bytes);
                }
            } catch (const py::error_already_set&) {
                raised = std::current_exception();
                throw index::Interrupted("the arrays cannot be read");
            }
        };
    }
    const py::gil_scoped_release release;
    try {
        return build_run(files, out, words, times, given ? &arrays : nullptr, report);
    } catch (const index::Interrupted&) {
        if (raised)
            std::rethrow_exception(raised);
        throw;
    }
}

/// Raises what isochron._errors makes of a message.
void raise(const char* what, bool missing) {
    const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(what));
    const py::object error =
        py::module_::import("isochron._errors").attr("error_of")(text, missing);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown)
            std::rethrow_exception(thrown);
    } catch (const index::MissingFile& error) {
        raise(error.what(), true);
    } catch (const index::Error& error) {
        raise(error.what(), false);
    } catch (const UsageError& error) {
        raise(error.what(), false);
    } catch (const std::system_error& error) { // a failure of the file system, or no more threads
        raise(error.what(), false);
    }
}

std::vector<std::string> names_of(const OpenRun& run) {
    return index::array_names(run.file());
}

/// The measures of a surface, and a row of numbers for each of its pieces.
py::tuple measure(RunArray& array, std::int64_t step, std::int64_t fraction, double isovalue,
                  const std::optional<std::string>& on_surface, bool pieces,
                  const std::optional<std::array<std::array<std::uint32_t, 2>, 3>>& crop,
                  const std::optional<std::array<double, 6>>& clip, std::uint32_t dust,
                  const std::optional<std::array<double, 3>>& from) {
    std::optional<index::CutPlane> plane;
    if (clip)
        plane = {{(*clip)[0], (*clip)[1], (*clip)[2]}, {(*clip)[3], (*clip)[4], (*clip)[5]}};
    std::optional<index::VertexBox> box;
    if (crop) // x, y, z: the first and the last
        box = {{(*crop)[0][0], (*crop)[1][0], (*crop)[2][0]},
               {(*crop)[0][1], (*crop)[1][1], (*crop)[2][1]}};
    std::optional<glm::dvec3> place;
    if (from)
        place.emplace((*from)[0], (*from)[1], (*from)[2]);
    index::MeasuredSurface found = unlocked([&] {
        return array.measure({step, fraction}, isovalue, on_surface, pieces, box, plane, dust,
                             place);
    });
    std::vector<double> rows;
    for (const index::MeasuredPiece& piece : found.pieces) {
        rows.insert(rows.end(), {static_cast<double>(piece.triangles), piece.area, piece.volume,
                                 static_cast<double>(piece.euler), piece.closed ? 1.0 : 0.0});
        for (const auto& place : {piece.centroid, piece.low, piece.high})
            rows.insert(rows.end(), place.begin(), place.end());
    }
    const auto count = static_cast<py::ssize_t>(found.pieces.size());
    return py::make_tuple(std::move(found.values), owned(std::move(rows), {count, 14}));
}

/// Five numbers for each sample, as index::rows_of has them.
py::array profile(const RunArray& array, std::int64_t step, std::int64_t fraction,
                  const std::vector<std::array<double, 3>>& places) {
    std::vector<glm::dvec3> path;
    for (const auto& [x, y, z] : places)
        path.emplace_back(x, y, z);
    std::vector<double> rows =
        unlocked([&] { return array.profile({step, fraction}, std::move(path)); });
    const auto samples = static_cast<py::ssize_t>(rows.size() / 5);
    return owned(std::move(rows), {samples, 5});
}

std::vector<std::string> measure_names() {
    std::vector<std::string> names;
    for (const index::Measure& each : index::measures())
        names.emplace_back(each.name);
    return names;
}

/// Lets Ctrl-C end a wait for a server.
void raise_signals() {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
}

} // namespace

PYBIND11_MODULE(_native, module) {
    using namespace py::literals;
    module.attr("__version__") = ISOCHRON_VERSION;
    py::register_exception_translator(&translate);
    module.attr("FROM_INSTALLED") = ISOCHRON_FROM_INSTALLED;
    module.attr("FROM_BUILT") = ISOCHRON_FROM_BUILT;
    module.def("set_program_folder", &index::set_program_folder, "folder"_a);
    module.def(
        "address_of", [](const std::string& name) { return index::address_of(name); }, "name"_a);
    module.def(
        "is_link", [](const std::string& name) { return index::is_link(name); }, "name"_a);
    module.def("authorization_for", [](const std::string& address) {
        const std::string value = index::is_link(address) ? index::authorization_for(address) : "";
        return value.empty() ? value : index::host_of_link(address) + " " + value;
    });
    index::call_while_waiting_for_links(&raise_signals);
    module.def("times_in", &index::times_in, "wanted"_a, "given"_a, "times"_a);
    module.def("measure_names", &measure_names);
    module.def("build", &build, "files"_a, "out"_a, "words"_a, "times"_a, "arrays"_a, "progress"_a);

    py::class_<RunArray>(module, "RunArray")
        .def("cells", &cells, "step"_a, "fraction"_a, "isovalue"_a, "level"_a)
        .def("change", &change, "step"_a, "fraction"_a, "isovalue"_a, "to_step"_a, "to_fraction"_a,
             "to_isovalue"_a)
        .def("mesh", &mesh, "step"_a, "fraction"_a, "isovalue"_a, "absolute"_a, "level"_a,
             "normals"_a, "values"_a, "dust"_a)
        .def("measure", &measure, "step"_a, "fraction"_a, "isovalue"_a, "on_surface"_a, "pieces"_a,
             "crop"_a, "clip"_a, "dust"_a, "place"_a)
        .def("profile", &profile, "step"_a, "fraction"_a, "places"_a)
        .def("values", &values, "step"_a, "fraction"_a, "box"_a, "level"_a)
        .def("first_crossings", &first_crossings, "isovalue"_a, "blended"_a)
        .def("description", &description)
        .def("read_bytes", &read_bytes);
    py::class_<OpenRun, std::shared_ptr<OpenRun>>(module, "OpenRun")
        .def(py::init<const std::filesystem::path&>(), "path"_a, Unlocked())
        .def("array", &OpenRun::array, "name"_a, py::return_value_policy::reference_internal)
        .def("names", &names_of)
        .def("lost", &OpenRun::lost);
}

} // namespace isochron::app
