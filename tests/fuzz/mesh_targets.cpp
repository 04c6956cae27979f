// Fuzz targets: grids as VTK's readers may give them, resampled and read; text that is checked and
// changed before VTK reads it.
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

#include "index/error.h"
#include "index/readers/decoders/reader_service.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_numbers.h"
#include "index/readers/decoders/vtk/vtk_resample.h"
#include "index/readers/decoders/vtk/vtk_session.h"
#include "index/readers/decoders/vtk/xml_markup.h"

#include <vtkAMRBox.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUniformGrid.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace isochron::fuzz {
namespace {

/// The input as a row of small choices; 0 behind its end.
class Choices {
  public:
    explicit Choices(Bytes input) : rest_(input) {}

    bool more() const { return !rest_.empty(); }
    /// From 0 to count - 1.
    int below(int count) {
        if (rest_.empty())
            return 0;
        const int byte = rest_.front();
        rest_ = rest_.subspan(1);
        return byte % count;
    }
    template <class T, std::size_t kCount>
    T one_of(const std::array<T, kCount>& all) {
        return all[static_cast<std::size_t>(below(static_cast<int>(kCount)))];
    }
    /// A small number mostly, now and then one that is hard.
    double number() {
        constexpr std::array kHard{std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   1e300,
                                   -1e300,
                                   1e-300,
                                   1e30,
                                   16777217.0};
        const int byte = below(256);
        constexpr int kFirstHard = 248;
        return byte < kFirstHard ? (byte - 8) / 16.0
                                 : kHard[static_cast<std::size_t>(byte - kFirstHard)];
    }

  private:
    Bytes rest_;
};

void add_arrays(Choices& choices, vtkFieldData& to, vtkIdType tuples) {
    static constexpr std::array<const char*, 8> kNames{
        "rho", "v", "vtkGhostType", "vtkGhostLevels", "", nullptr, "a\nb", "vtkValidPointMask"};
    static constexpr std::array kTypes{VTK_FLOAT, VTK_DOUBLE,    VTK_UNSIGNED_CHAR,
                                       VTK_SHORT, VTK_LONG_LONG, VTK_UNSIGNED_INT,
                                       VTK_BIT,   VTK_CHAR};
    for (int count = choices.below(4); count > 0; --count) {
        const char* const name = choices.one_of(kNames);
        const bool flags = name && std::string(name) == index::kGhostFlags[0];
        const auto array = vtkSmartPointer<vtkDataArray>::Take(
            vtkDataArray::CreateDataArray(flags ? VTK_UNSIGNED_CHAR : choices.one_of(kTypes)));
        array->SetName(name);
        array->SetNumberOfComponents(1 + choices.below(8) % 4);
        constexpr std::array kOff{0, 0, 0, 0, 0, 1, -1, 5};
        array->SetNumberOfTuples(std::max<vtkIdType>(0, tuples + choices.one_of(kOff)));
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
            for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
                const double number = choices.number();
                const bool whole =
                    array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
                array->SetComponent(i, c, whole ? choices.below(8) : number);
            }
        to.AddArray(array);
    }
    if (choices.below(16) == 1) {
        const vtkNew<vtkStringArray> text;
        text->SetName("text");
        text->SetNumberOfTuples(tuples);
        to.AddArray(text);
    }
}

void fill(Choices& choices, vtkDataSet& grid) {
    add_arrays(choices, *grid.GetPointData(), grid.GetNumberOfPoints());
    add_arrays(choices, *grid.GetCellData(), grid.GetNumberOfCells());
}

vtkNew<vtkPoints> points_of(Choices& choices, int count) {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < count; ++i) {
        std::array<double, 3> at{};
        for (double& each : at)
            each = choices.number();
        points->InsertNextPoint(at.data());
    }
    return points;
}

vtkSmartPointer<vtkDataObject> unstructured(Choices& choices) {
    constexpr std::array<std::pair<int, int>, 12> kCells{{{VTK_TETRA, 4},
                                                          {VTK_HEXAHEDRON, 8},
                                                          {VTK_VOXEL, 8},
                                                          {VTK_WEDGE, 6},
                                                          {VTK_PYRAMID, 5},
                                                          {VTK_QUADRATIC_TETRA, 10},
                                                          {VTK_VERTEX, 1},
                                                          {VTK_LINE, 2},
                                                          {VTK_TRIANGLE, 3},
                                                          {VTK_QUAD, 4},
                                                          {VTK_POLYGON, 5},
                                                          {VTK_EMPTY_CELL, 0}}};
    const vtkNew<vtkUnstructuredGrid> grid;
    const int points = choices.below(33);
    grid->SetPoints(points_of(choices, points));
    grid->Allocate(1);
    for (int cells = points > 0 ? choices.below(12) : 0; cells > 0; --cells) {
        const auto [type, corners] = choices.one_of(kCells);
        std::array<vtkIdType, 10> ids{};
        for (int i = 0; i < corners; ++i) // mostly one after the other, as meshes have them
            ids[static_cast<std::size_t>(i)] =
                (i + choices.below(8) % 3 * choices.below(5)) % points;
        grid->InsertNextCell(type, corners, ids.data());
    }
    fill(choices, *grid);
    return grid.GetPointer();
}

/// A surface of triangles and lines.
vtkSmartPointer<vtkDataObject> surface(Choices& choices) {
    const vtkNew<vtkPolyData> grid;
    const int points = 3 + choices.below(8);
    grid->SetPoints(points_of(choices, points));
    grid->AllocateEstimate(1, 3);
    for (int cells = choices.below(4); cells > 0; --cells) {
        const std::array<vtkIdType, 3> ids{choices.below(points), choices.below(points),
                                           choices.below(points)};
        grid->InsertNextCell(choices.below(2) ? VTK_TRIANGLE : VTK_POLY_LINE, 3, ids.data());
    }
    fill(choices, *grid);
    return grid.GetPointer();
}

vtkSmartPointer<vtkDataObject> curvilinear(Choices& choices) {
    const vtkNew<vtkStructuredGrid> grid;
    const std::array sizes{choices.below(5), choices.below(5), choices.below(4)};
    grid->SetPoints(points_of(choices, sizes[0] * sizes[1] * sizes[2]));
    grid->SetDimensions(sizes.data());
    fill(choices, *grid);
    return grid.GetPointer();
}

vtkSmartPointer<vtkDataObject> rectilinear(Choices& choices) {
    const vtkNew<vtkRectilinearGrid> grid;
    const std::array sizes{1 + choices.below(5), 1 + choices.below(5), 1 + choices.below(4)};
    grid->SetDimensions(sizes.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at =
            vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_DOUBLE));
        double place = choices.number();
        for (int i = 0; i < sizes[axis]; ++i)
            at->InsertNextTuple1(place += choices.below(9) ? 0.5 : choices.number());
        (axis == 0   ? grid->SetXCoordinates(at)
         : axis == 1 ? grid->SetYCoordinates(at)
                     : grid->SetZCoordinates(at));
    }
    fill(choices, *grid);
    return grid.GetPointer();
}

void place(Choices& choices, vtkImageData& image) {
    const std::array extent{0, choices.below(5), 0, choices.below(5), 0, choices.below(5)};
    image.SetExtent(const_cast<int*>(extent.data()));
    image.SetOrigin(choices.number(), choices.number(), choices.number());
    image.SetSpacing(choices.number(), choices.number(), choices.number());
}

vtkSmartPointer<vtkDataObject> even(Choices& choices) {
    const vtkNew<vtkImageData> image;
    place(choices, *image);
    fill(choices, *image);
    return image.GetPointer();
}

/// Two levels with boxes of cells, the second twice as fine.
vtkSmartPointer<vtkDataObject> refined(Choices& choices) {
    const vtkNew<vtkOverlappingAMR> levels;
    const std::array<int, 2> boxes{1, choices.below(3)};
    levels->Initialize(2, boxes.data());
    const std::array<double, 3> origin{choices.number(), choices.number(), choices.number()};
    levels->SetOrigin(origin.data());
    levels->SetGridDescription(VTK_XYZ_GRID);
    for (unsigned level = 0; level < 2; ++level) {
        const double step = level == 0 ? 1 : 0.5;
        const std::array<double, 3> spacing{step, step, step};
        levels->SetSpacing(level, spacing.data());
        for (unsigned number = 0; number < levels->GetNumberOfDataSets(level); ++number) {
            const vtkNew<vtkUniformGrid> grid;
            std::array<double, 3> first{};
            std::array<int, 3> sizes{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                first[axis] = origin[axis] + choices.below(4) * step;
                sizes[axis] = 2 + choices.below(4);
            }
            grid->SetOrigin(first.data());
            grid->SetSpacing(spacing.data());
            grid->SetDimensions(sizes.data());
            fill(choices, *grid);
            levels->SetAMRBox(
                level, number,
                vtkAMRBox(first.data(), sizes.data(), spacing.data(), origin.data(), VTK_XYZ_GRID));
            levels->SetDataSet(level, number, grid);
        }
    }
    return levels.GetPointer();
}

vtkSmartPointer<vtkDataObject> grid_of(Choices& choices, int depth) {
    switch (choices.below(depth > 0 ? 8 : 5)) {
    case 0: return unstructured(choices);
    case 1: return curvilinear(choices);
    case 2: return even(choices);
    case 3: return rectilinear(choices);
    case 4: return surface(choices);
    case 5: return refined(choices);
    default: break;
    }
    const vtkNew<vtkMultiBlockDataSet> blocks;
    const unsigned count = static_cast<unsigned>(choices.below(4));
    blocks->SetNumberOfBlocks(count);
    for (unsigned i = 0; i < count; ++i)
        if (choices.below(8) > 0) // else there is none
            blocks->SetBlock(i, grid_of(choices, depth - 1));
    return blocks.GetPointer();
}

/// Reads an image as the readers do. @param data what it was made of
void read_image(vtkDataObject& data, vtkImageData& image, const index::ReadOptions& options) {
    const index::Grid grid =
        index::grid_of_vtk(*reinterpret_cast<int(*)[6]>(image.GetExtent()), image.GetOrigin(),
                           image.GetSpacing(), image.GetDirectionMatrix()->GetData(), "mesh");
    const index::ChosenScalar chosen =
        index::choose_scalar(index::without_flags(index::arrays_of_vtk(image)), options, "mesh");
    const auto hidden = index::hidden_by_flags(index::flags_of_vtk(image, grid), chosen, grid);
    const std::uint64_t tuples = chosen.array.on_cells ? grid.cell_count() : grid.vertex_count();
    claim(hidden.empty() || hidden.size() == tuples, "every tuple is hidden or not");
    claim_one_line(index::in_one_line(index::note_on_resampling(data, image, chosen, hidden)));
    index::SeriesInfo info;
    info.grid = grid;
    info.type = chosen.value_type();
    std::vector<std::byte> values(info.step_bytes());
    const std::uint32_t slices = grid.vertices[2];
    const std::uint32_t at_once = std::min(index::slices_of_vtk(chosen, info), slices);
    for (std::uint32_t first = 0; first < slices; first += at_once) {
        const std::uint32_t count = std::min(at_once, slices - first);
        const std::size_t slice = values.size() / slices;
        index::values_of_vtk(image, chosen, grid, {first, count}, hidden,
                             std::span(values).subspan(first * slice, count * slice), "mesh");
    }
    if (info.type != index::ValueType::f64 || chosen.array.on_cells || hidden.empty())
        return;
    const auto* numbers = reinterpret_cast<const double*>(values.data());
    for (std::size_t i = 0; i < hidden.size(); ++i)
        claim(hidden[i] == 0 || std::isnan(numbers[i]), "what is hidden is missing");
}

/// Two steps of a mesh, the second onto the vertices of the first.
void fuzz_mesh(Bytes input) {
    Choices choices(input);
    constexpr int kDeepest = 2;
    try {
        index::with_vtk("mesh", [&] {
            const std::array<const char*, 4> names{nullptr, "rho", "v", "none"};
            constexpr std::array<const char*, 5> kComponents{nullptr, "0", "1", "magnitude", "7"};
            index::ReadOptions options;
            options.any_array = choices.below(2) == 1;
            if (const char* name = choices.one_of(names))
                options.array = name;
            if (const char* component = choices.one_of(kComponents))
                options.component = component;
            std::array<std::uint32_t, 3> vertices{};
            for (std::uint32_t& along : vertices)
                along = static_cast<std::uint32_t>(2 + choices.below(6));
            const bool by_cells = choices.below(4) == 1;
            const auto data = grid_of(choices, kDeepest);
            if (by_cells) {
                vertices = index::vertices_by_cells(*data, "mesh");
                constexpr std::uint64_t kMost = 1 << 15;
                if (std::uint64_t{vertices[0]} * vertices[1] * vertices[2] > kMost)
                    return;
            }
            const auto image = index::onto_image(*data, vertices, "mesh");
            read_image(*data, *image, options);
            if (!choices.more())
                return;
            const auto later = grid_of(choices, kDeepest);
            const auto there = index::onto_image_like(*later, *image, "mesh");
            claim(std::equal(image->GetDimensions(), image->GetDimensions() + 3,
                             there->GetDimensions()),
                  "all steps have the same vertices");
            read_image(*later, *there, options);
        });
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

void fuzz_vtk_text(Bytes input) {
    const MemoryFile memory(input);
    try {
        const index::MappedFile file{std::filesystem::path(memory.path())};
        const std::string_view markup = index::markup_of(file);
        if (const auto legacy = index::with_stand_ins(
                {reinterpret_cast<const char*>(input.data()), input.size()}, "text"))
            claim(!legacy->empty(), "a text with stand-ins is not empty");
        index::expect_end(file, "text");
        index::expect_shallow(markup, "text");
        index::expect_names(markup, "text");
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

} // namespace

std::span<const Target> mesh_targets() {
    static constexpr std::array kTargets{Target{"mesh", fuzz_mesh},
                                         Target{"vtk_text", fuzz_vtk_text}};
    return kTargets;
}

} // namespace isochron::fuzz
