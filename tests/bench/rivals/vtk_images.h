// The steps of a series as VTK images, for the modules that use VTK.
#pragma once

#include "index/volume/step_values.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace isochron::bench {

inline int vtk_type(index::ValueType type) {
    switch (type) {
    case index::ValueType::i8: return VTK_SIGNED_CHAR;
    case index::ValueType::u8: return VTK_UNSIGNED_CHAR;
    case index::ValueType::i16: return VTK_SHORT;
    case index::ValueType::u16: return VTK_UNSIGNED_SHORT;
    case index::ValueType::i32: return VTK_INT;
    case index::ValueType::f32: return VTK_FLOAT;
    case index::ValueType::f64: break;
    }
    return VTK_DOUBLE;
}

/// Without copies: the values must outlive the images.
inline std::vector<vtkSmartPointer<vtkImageData>> vtk_images(const index::StepValues& values) {
    std::vector<vtkSmartPointer<vtkImageData>> images;
    const auto& n = values.grid.vertices;
    const auto& spacing = values.grid.spacing;
    for (std::size_t step = 0; step < values.steps; ++step) {
        auto scalars = vtkSmartPointer<vtkDataArray>::Take(
            vtkDataArray::CreateDataArray(vtk_type(values.type)));
        // VTK reads the same memory as everything else, and never writes to it.
        scalars->SetVoidArray(const_cast<std::byte*>(values.first + step * values.stride),
                              static_cast<vtkIdType>(values.grid.vertex_count()), 1);
        auto image = vtkSmartPointer<vtkImageData>::New();
        image->SetDimensions(static_cast<int>(n[0]), static_cast<int>(n[1]),
                             static_cast<int>(n[2]));
        image->SetSpacing(spacing.x, spacing.y, spacing.z);
        image->GetPointData()->SetScalars(scalars);
        images.push_back(image);
    }
    return images;
}

} // namespace isochron::bench
