// Notes on what data that VTK has read state, after the keys that VTK writes with its arrays.
#include "index/readers/decoders/vtk/vtk_fields.h"
#include "index/readers/decoders/vtk/vtk_resample.h"

#include <fmt/format.h>

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationIterator.h>
#include <vtkInformationKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace isochron::index {
namespace {

/// Field data that VTK's readers of meshes add, of what is said elsewhere.
constexpr std::array kOfReaders{"ElementBlockIds", "Title", "CasePath"};

/// Unit and further keys of an array.
void take_array(vtkAbstractArray& array, bool chosen, UnreadFields& unread, SeriesInfo& info) {
    const std::string name = array.GetName() ? array.GetName() : "";
    if (!array.HasInformation())
        return;
    const vtkNew<vtkInformationIterator> each;
    each->SetInformation(array.GetInformation());
    for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem()) {
        const std::string key = each->GetCurrentKey()->GetName();
        if (key == kUnit && chosen)
            info.value_unit = array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
        if (key != kUnit && !is_one_of(kRanges, key))
            unread.add(fmt::format("{} {}", name, key), "");
    }
}

} // namespace

void take_fields_of_vtk(vtkDataObject& data, const ChosenScalar& chosen, SeriesInfo& info) {
    UnreadFields unread;
    const auto take_arrays = [&](vtkFieldData* fields, bool of_chosen) {
        for (int i = 0; fields && i < fields->GetNumberOfArrays(); ++i) {
            vtkAbstractArray& array = *fields->GetAbstractArray(i);
            const bool is_chosen = array.GetName() && array.GetName() == chosen.array.name;
            take_array(array, of_chosen && is_chosen, unread, info);
        }
    };
    const auto take_others = [&](vtkFieldData* fields) {
        for (int i = 0; fields && i < fields->GetNumberOfArrays(); ++i)
            if (const char* name = fields->GetAbstractArray(i)->GetName();
                name && !is_one_of(kTimeFields, name) && !is_one_of(kOfReaders, name))
                unread.add(fmt::format("FieldData {}", name), "");
    };
    take_others(data.GetFieldData());
    each_grid(data, [&](vtkDataSet& grid) {
        // Arrays of cells become arrays of points where a grid is resampled.
        take_arrays(grid.GetPointData(), true);
        take_arrays(grid.GetCellData(), !grid.GetPointData()->HasArray(chosen.array.name.c_str()));
        if (&grid != &data)
            take_others(grid.GetFieldData());
    });
    unread.tell(info);
}

} // namespace isochron::index
