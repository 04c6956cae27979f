// Turns VTK's messages into errors, and its arrays into ours.
#include "index/readers/decoders/vtk/vtk_session.h"

#include "index/error.h"
#include "index/readers/formats/stored_file.h"

#include <fmt/format.h>

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>

#include <cassert>
#include <new>
#include <stdexcept>
#include <string_view>

namespace isochron::index {
namespace {

/// Keeps the first error and prints nothing.
class MessageCollector : public vtkOutputWindow {
  public:
    static MessageCollector* New();
    vtkTypeMacro(MessageCollector, vtkOutputWindow)

        void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        if (first_error_.empty())
            first_error_ = text;
    }
    void DisplayWarningText(const char* text) override { keep_read_error(text); }
    void DisplayGenericWarningText(const char* text) override { keep_read_error(text); }
    void DisplayDebugText(const char*) override {}

    const std::string& first_error() const { return first_error_; }

  private:
    // VTK only warns of legacy files that end too early.
    void keep_read_error(std::string_view text) {
        if (first_error_.empty() && text.find("Error reading") != text.npos)
            first_error_ = text;
    }

    std::string first_error_;
};
vtkStandardNewMacro(MessageCollector)

    /// Sets VTK's output window, and restores the former one at the end of the scope.
    class OutputWindowScope {
  public:
    explicit OutputWindowScope(vtkOutputWindow* window)
        : former_(vtkOutputWindow::GetInstance()),
          verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
        vtkOutputWindow::SetInstance(window);
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    }
    ~OutputWindowScope() {
        vtkOutputWindow::SetInstance(former_);
        vtkLogger::SetStderrVerbosity(verbosity_);
    }
    OutputWindowScope(const OutputWindowScope&) = delete;
    OutputWindowScope& operator=(const OutputWindowScope&) = delete;

  private:
    vtkSmartPointer<vtkOutputWindow> former_;
    vtkLogger::Verbosity verbosity_;
};

// `ERROR: In vtkX.cxx, line 9\nvtkX (0x55): what happened\n\n` -> `what happened`, and the same of
// `Generic Warning: In vtkX.cxx, line 9\nwhat happened\n\n`.
std::string one_line(std::string text) {
    if (text.find(": In ") != std::string::npos && text.find('\n') != std::string::npos)
        text.erase(0, text.find('\n') + 1);
    if (const std::size_t at = text.find("): "); at != std::string::npos)
        text.erase(0, at + 3);
    std::string line;
    for (char c : text) {
        const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (line.ends_with(' '))
        line.pop_back();
    return line;
}

std::uint64_t tuples_of(const ChosenScalar& chosen, const Grid& grid) {
    return chosen.array.on_cells ? grid.cell_count() : grid.vertex_count();
}

} // namespace

void with_vtk(const std::filesystem::path& file, const std::function<void()>& work) {
    const auto messages = vtkSmartPointer<MessageCollector>::New();
    const auto fail_on_message = [&] {
        if (!messages->first_error().empty())
            throw Error(fmt::format("{}: cannot be read: {}", file.string(),
                                    one_line(messages->first_error())));
    };
    try {
        const OutputWindowScope scope(messages);
        work();
    } catch (const Error&) {
        // VTK's first message is the cause of a later error.
        fail_on_message();
        throw;
    } catch (const std::bad_alloc&) {
        throw; // the reader's service adds how much memory there was
    } catch (const std::length_error&) {
        throw Error(fmt::format("{}: cannot be read: VTK took a number of it for a size that no "
                                "memory has",
                                file.string()));
    } catch (const std::exception& other) {
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), one_line(other.what())));
    }
    fail_on_message();
}

std::optional<StoredType> stored_type_of_vtk(int type) {
    const auto signed_of = [](std::size_t size) {
        return size == 8 ? StoredType::i64 : StoredType::i32;
    };
    const auto unsigned_of = [](std::size_t size) {
        return size == 8 ? StoredType::u64 : StoredType::u32;
    };
    switch (type) {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR: return StoredType::i8;
    case VTK_UNSIGNED_CHAR: return StoredType::u8;
    case VTK_SHORT: return StoredType::i16;
    case VTK_UNSIGNED_SHORT: return StoredType::u16;
    case VTK_INT: return StoredType::i32;
    case VTK_UNSIGNED_INT: return StoredType::u32;
    case VTK_LONG: return signed_of(sizeof(long));
    case VTK_UNSIGNED_LONG: return unsigned_of(sizeof(long));
    case VTK_LONG_LONG: return StoredType::i64;
    case VTK_UNSIGNED_LONG_LONG: return StoredType::u64;
    case VTK_ID_TYPE: return signed_of(sizeof(vtkIdType));
    case VTK_FLOAT: return StoredType::f32;
    case VTK_DOUBLE: return StoredType::f64;
    default: return std::nullopt;
    }
}

Grid grid_of_vtk(const int (&extent)[6], const double* origin, const double* spacing,
                 const double* direction, const std::string& file) {
    Grid grid;
    std::array<std::int64_t, 3> sizes{};
    glm::dmat3 steps;
    for (int axis = 0; axis < 3; ++axis) {
        sizes[axis] = std::int64_t{extent[2 * axis + 1]} - extent[2 * axis] + 1;
        for (int row = 0; row < 3; ++row)
            steps[axis][row] = direction[3 * row + axis] * spacing[axis];
    }
    grid.vertices = checked_vertices(sizes, file);
    set_axes(grid, steps, file);
    grid.origin = glm::dvec3(origin[0], origin[1], origin[2]) +
                  steps * glm::dvec3(extent[0], extent[2], extent[4]);
    return grid;
}

void values_of_vtk(vtkDataSet& image, const ChosenScalar& chosen, const Grid& grid, Slices slices,
                   std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                   const std::string& file) {
    vtkFieldData* fields = chosen.array.on_cells ? static_cast<vtkFieldData*>(image.GetCellData())
                                                 : static_cast<vtkFieldData*>(image.GetPointData());
    vtkDataArray* array =
        vtkDataArray::SafeDownCast(fields->GetAbstractArray(chosen.array.name.c_str()));
    if (!array)
        throw Error(fmt::format("{}: array {} cannot be read", file, chosen.array.name));
    const std::uint64_t tuples = tuples_of(chosen, grid);
    if (static_cast<std::uint64_t>(array->GetNumberOfTuples()) != tuples)
        throw Error(fmt::format("{}: array {} has {} tuples, expected {}", file, chosen.array.name,
                                array->GetNumberOfTuples(), tuples));
    if (stored_type_of_vtk(array->GetDataType()) != chosen.array.type ||
        static_cast<std::uint32_t>(array->GetNumberOfComponents()) != chosen.array.components)
        throw Error(fmt::format("{}: array {} has changed its type", file, chosen.array.name));
    const std::span all(static_cast<const std::byte*>(array->GetVoidPointer(0)),
                        bytes_of_vtk(chosen, grid));
    if (slices.count == grid.vertices[2])
        return convert(chosen, all, grid, out, file, hidden);
    assert(!chosen.array.on_cells);
    Grid slab = grid;
    slab.vertices[2] = slices.count;
    const std::uint64_t slice = all.size() / grid.vertices[2];
    if (!hidden.empty()) {
        const std::size_t layer = hidden.size() / grid.vertices[2];
        hidden = hidden.subspan(slices.first * layer, slices.count * layer);
    }
    convert(chosen, all.subspan(slices.first * slice, slices.count * slice), slab, out, file,
            hidden);
}

std::uint32_t slices_of_vtk(const ChosenScalar& chosen, const SeriesInfo& info) {
    return chosen.array.on_cells ? info.grid.vertices[2] : slices_worth_asking(info);
}

std::uint64_t bytes_of_vtk(const ChosenScalar& chosen, const Grid& grid) {
    return tuples_of(chosen, grid) * chosen.array.components * size_of(*chosen.array.type);
}

std::vector<StoredArray> arrays_of_vtk(vtkDataSet& image) {
    std::vector<StoredArray> arrays;
    const auto add = [&](vtkFieldData* fields, bool on_cells) {
        for (int i = 0; i < fields->GetNumberOfArrays(); ++i) {
            vtkAbstractArray* array = fields->GetAbstractArray(i);
            arrays.push_back(
                {array->GetName() ? array->GetName() : "", stored_type_of_vtk(array->GetDataType()),
                 static_cast<std::uint32_t>(array->GetNumberOfComponents()), on_cells});
        }
    };
    add(image.GetPointData(), false);
    add(image.GetCellData(), true);
    return arrays;
}

void take_time_of_vtk(vtkFieldData* fields, SeriesInfo& info) {
    info.times.clear();
    // The names that ParaView, VisIt and other programs use.
    for (const char* name : {"TimeValue", "TIME", "TimeStep"}) {
        vtkDataArray* time = fields ? fields->GetArray(name) : nullptr;
        if (!time || time->GetNumberOfTuples() != 1 || time->GetNumberOfComponents() != 1)
            continue;
        info.times = {time->GetTuple1(0)};
        if (std::string_view(name) != "TimeValue")
            info.notes.push_back(fmt::format("times are those of the field {}", name));
        return;
    }
}

} // namespace isochron::index
