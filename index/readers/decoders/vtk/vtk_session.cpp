// Turns VTK's messages into errors, and its arrays into ours.
#include "index/readers/decoders/vtk/vtk_session.h"

#include "index/error.h"
#include "index/readers/decoders/vtk/vtk_fields.h"

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

} // namespace

void with_vtk(const std::filesystem::path& file, const std::function<void()>& work) {
    const auto messages = vtkSmartPointer<MessageCollector>::New();
    const auto fail_on_message = [&] {
        if (!messages->first_error().empty())
            throw Error("{}: cannot be read: {}", file.string(), one_line(messages->first_error()));
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
        throw Error("{}: cannot be read: VTK took a number of it for a size that no memory has",
                    file.string());
    } catch (const std::exception& other) {
        throw Error("{}: cannot be read: {}", file.string(), one_line(other.what()));
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

void values_of_vtk(vtkDataSet& image, const ChosenScalar& chosen, const Grid& grid, Slices slices,
                   std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                   const std::string& file) {
    vtkFieldData* fields = chosen.array.on_cells ? static_cast<vtkFieldData*>(image.GetCellData())
                                                 : static_cast<vtkFieldData*>(image.GetPointData());
    vtkDataArray* array =
        vtkDataArray::SafeDownCast(fields->GetAbstractArray(chosen.array.name.c_str()));
    if (!array)
        throw Error("{}: array {} cannot be read", file, chosen.array.name);
    const std::uint64_t tuples = tuples_of_vtk(chosen, grid);
    if (static_cast<std::uint64_t>(array->GetNumberOfTuples()) != tuples)
        throw Error("{}: array {} has {} tuples, expected {}", file, chosen.array.name,
                    array->GetNumberOfTuples(), tuples);
    if (stored_type_of_vtk(array->GetDataType()) != chosen.array.type ||
        static_cast<std::uint32_t>(array->GetNumberOfComponents()) != chosen.array.components)
        throw Error("{}: array {} has changed its type", file, chosen.array.name);
    const std::span all(static_cast<const std::byte*>(array->GetVoidPointer(0)),
                        bytes_of_vtk(chosen, grid));
    const std::uint64_t slice = all.size() / grid.vertices[2];
    convert_slices(chosen,
                   chosen.array.on_cells ? all
                                         : all.subspan(slices.first * slice, slices.count * slice),
                   grid, slices, hidden, out, file);
}

GhostFlags flags_of_vtk(vtkDataSet& image, const Grid& grid) {
    const auto flags_in = [](vtkFieldData* fields, std::size_t tuples) {
        std::vector<std::uint8_t> flags;
        for (const char* name : kGhostFlags) {
            vtkDataArray* array = vtkDataArray::SafeDownCast(fields->GetAbstractArray(name));
            if (!array || array->GetNumberOfComponents() != 1 ||
                static_cast<std::size_t>(array->GetNumberOfTuples()) != tuples)
                continue;
            flags.resize(tuples);
            for (std::size_t i = 0; i < tuples; ++i)
                flags[i] |= ghost_flag(name, array->GetTuple1(static_cast<vtkIdType>(i)));
        }
        return flags;
    };
    return {.points = flags_in(image.GetPointData(), grid.vertex_count()),
            .cells = flags_in(image.GetCellData(), grid.cell_count())};
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
    for (const char* name : kTimeFields) {
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
