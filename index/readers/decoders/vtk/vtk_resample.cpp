// Resampling by VTK (vtkResampleToImage), and what it loses.
#include "index/readers/decoders/vtk/vtk_resample.h"

#include "index/error.h"
#include "index/readers/formats/series/misfit.h"
#include "index/readers/formats/series/resampled_series.h"

#include <fmt/format.h>

#include <vtkAbstractArray.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkResampleToImage.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

/// Removes the flags of the vertices and cells that lay within a grid: VTK writes them when it
/// resamples, and ghost flags say the same.
void remove_masks(vtkDataSet& grid) {
    for (const char* mask : {"vtkValidPointMask", "vtkValidCellMask"}) {
        grid.GetPointData()->RemoveArray(mask);
        grid.GetCellData()->RemoveArray(mask);
    }
}

/// Checks what VTK takes for granted: it crashes on other data. Removes masks that the data bring
/// along, as these would take the place of the masks that VTK writes.
void make_sound(vtkDataObject& data, const std::string& file) {
    const auto check = [&](vtkFieldData& arrays, vtkIdType tuples) {
        for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
            vtkAbstractArray& array = *arrays.GetAbstractArray(i);
            if (array.GetNumberOfTuples() != tuples)
                throw Error("{}: array {} has {} values, expected {}", file,
                            array.GetName() ? array.GetName() : "without a name",
                            array.GetNumberOfTuples(), tuples);
        }
    };
    each_grid(data, [&](vtkDataSet& grid) {
        remove_masks(grid);
        check(*grid.GetPointData(), grid.GetNumberOfPoints());
        check(*grid.GetCellData(), grid.GetNumberOfCells());
        std::array<double, 6> box{};
        grid.GetBounds(box.data());
        if (!std::ranges::all_of(box, [](double at) { return std::isfinite(at); }))
            throw Error("{}: has points that are nowhere (not finite)", file);
    });
}

/// The chosen component, or the length, of a tuple.
double value_at(vtkDataArray& array, vtkIdType tuple, const ChosenScalar& chosen) {
    if (chosen.component != ChosenScalar::kMagnitude)
        return array.GetComponent(tuple, static_cast<int>(chosen.component));
    double sum = 0;
    for (int i = 0; i < array.GetNumberOfComponents(); ++i)
        sum += array.GetComponent(tuple, i) * array.GetComponent(tuple, i);
    return std::sqrt(sum);
}

/// Trilinear; NaN outside, and where one of the vertices is hidden.
double interpolated(vtkImageData& image, vtkDataArray& values, const ChosenScalar& chosen,
                    std::span<const std::uint8_t> hidden, std::array<double, 3> at) {
    std::array<int, 3> low{};
    std::array<double, 3> share{};
    if (!image.ComputeStructuredCoordinates(at.data(), low.data(), share.data()))
        return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<int, 3> place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool upper = (corner >> axis & 1) != 0;
            weight *= upper ? share[axis] : 1 - share[axis];
            place[axis] = low[axis] + upper;
        }
        if (weight == 0)
            continue;
        const vtkIdType vertex = image.ComputePointId(place.data());
        if (vertex < 0 || vertex >= values.GetNumberOfTuples() ||
            (!hidden.empty() && hidden[static_cast<std::size_t>(vertex)] != 0))
            return std::numeric_limits<double>::quiet_NaN();
        sum += weight * value_at(values, vertex, chosen);
    }
    return sum;
}

/// @param box lowest and highest coordinate along each axis; null: the data's own
vtkSmartPointer<vtkImageData> resampled_by(vtkDataObject& data,
                                           const std::array<std::uint32_t, 3>& counts,
                                           const double* box, const std::string& file) {
    make_sound(data, file);
    const vtkNew<vtkResampleToImage> filter;
    filter->SetInputDataObject(&data);
    filter->SetSamplingDimensions(static_cast<int>(counts[0]), static_cast<int>(counts[1]),
                                  static_cast<int>(counts[2]));
    if (box) {
        filter->UseInputBoundsOff();
        filter->SetSamplingBounds(box);
    }
    filter->Update();
    vtkSmartPointer<vtkImageData> image = filter->GetOutput();
    remove_masks(*image);
    return image;
}

} // namespace

void each_grid(vtkDataObject& data, const std::function<void(vtkDataSet&)>& take) {
    if (auto* one = vtkDataSet::SafeDownCast(&data))
        return take(*one);
    auto* all = vtkCompositeDataSet::SafeDownCast(&data);
    if (!all)
        return;
    const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(all->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
        if (auto* one = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()))
            take(*one);
}

std::array<std::uint32_t, 3> vertices_by_cells(vtkDataObject& data, const std::string& file) {
    constexpr double kMostVertices = 1 << 27;
    std::array<double, 3> low{}, high{}, least{};
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    least = low;
    each_grid(data, [&](vtkDataSet& grid) {
        for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
            std::array<double, 6> box{};
            grid.GetCellBounds(cell, box.data());
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], box[2 * axis]);
                high[axis] = std::max(high[axis], box[2 * axis + 1]);
                if (const double size = box[2 * axis + 1] - box[2 * axis]; size > 0)
                    least[axis] = std::min(least[axis], size);
            }
        }
    });
    std::array<double, 3> counts{};
    double all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(high[axis] > low[axis]) || !std::isfinite(least[axis]))
            throw Error("{}: holds no cells of three dimensions", file);
        constexpr double kRounding = 1e-6;
        counts[axis] = std::ceil((high[axis] - low[axis]) / least[axis] - kRounding) + 1;
        all *= counts[axis];
    }
    if (all > kMostVertices)
        throw Error("{}: its smallest cell asks for {} x {} x {} vertices, expected at most "
                    "{:.0f}; --resample NX NY NZ says how many",
                    file, counts[0], counts[1], counts[2], kMostVertices);
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        vertices[axis] = std::max(static_cast<std::uint32_t>(counts[axis]), 2u);
    return vertices;
}

vtkSmartPointer<vtkImageData> onto_image(vtkDataObject& data,
                                         const std::array<std::uint32_t, 3>& vertices,
                                         const std::string& file) {
    const auto counts = vertices == kBySmallestCell ? vertices_by_cells(data, file) : vertices;
    return resampled_by(data, counts, nullptr, file);
}

vtkSmartPointer<vtkImageData> onto_image_like(vtkDataObject& data, vtkImageData& like,
                                              const std::string& file) {
    const int* counts = like.GetDimensions();
    return resampled_by(data,
                        {static_cast<std::uint32_t>(counts[0]),
                         static_cast<std::uint32_t>(counts[1]),
                         static_cast<std::uint32_t>(counts[2])},
                        like.GetBounds(), file);
}

std::string note_on_resampling(vtkDataObject& data, vtkImageData& image, const ChosenScalar& chosen,
                               std::span<const std::uint8_t> hidden) {
    constexpr vtkIdType kMostPlaces = 1 << 20; // compared vertices of each grid
    Misfit misfit;
    const char* name = chosen.array.name.c_str();
    vtkDataArray* values = image.GetPointData()->GetArray(name);
    each_grid(data, [&](vtkDataSet& grid) {
        vtkDataArray* own = grid.GetPointData()->GetArray(name);
        const bool on_cells = !own;
        if (on_cells)
            own = grid.GetCellData()->GetArray(name);
        if (!own || !values)
            return;
        // Cells that finer ones stand for do not show their values.
        vtkUnsignedCharArray* ghosts = on_cells ? grid.GetCellGhostArray() : nullptr;
        const vtkIdType count = on_cells ? grid.GetNumberOfCells() : grid.GetNumberOfPoints();
        const vtkIdType stride = count / kMostPlaces + 1;
        for (vtkIdType i = 0; i < std::min(count, own->GetNumberOfTuples()); i += stride) {
            if (ghosts && ghosts->GetValue(i) != 0)
                continue;
            std::array<double, 3> at{};
            if (on_cells) {
                std::array<double, 6> box{};
                grid.GetCellBounds(i, box.data());
                at = {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2};
            } else {
                grid.GetPoint(i, at.data());
            }
            misfit.add(value_at(*own, i, chosen), interpolated(image, *values, chosen, hidden, at));
        }
    });
    const int* counts = image.GetDimensions();
    return fmt::format(
        "resampled from {} by VTK onto {} x {} x {} vertices; at its {} these are {}",
        data.GetClassName(), counts[0], counts[1], counts[2],
        chosen.array.on_cells ? "cells" : "points", misfit.text());
}

} // namespace isochron::index
