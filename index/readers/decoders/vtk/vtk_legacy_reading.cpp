// Asks for every kind of array.
#include "index/readers/decoders/vtk/vtk_legacy_reading.h"

#include "index/readers/decoders/vtk/vtk_numbers.h"
#include "index/readers/formats/data_stream.h"

#include <vtkCellData.h>
#include <vtkDataReader.h>
#include <vtkDataSet.h>
#include <vtkPointData.h>

namespace isochron::index {

void read_all(vtkDataReader& reader, const std::filesystem::path& path) {
    reader.SetFileName(path.c_str());
    const auto text = text_with_stand_ins(path);
    if (text) {
        reader.SetInputString(*text);
        reader.ReadFromInputStringOn();
    }
    reader.ReadAllScalarsOn();
    reader.ReadAllVectorsOn();
    reader.ReadAllNormalsOn();
    reader.ReadAllTensorsOn();
    reader.ReadAllColorScalarsOn();
    reader.ReadAllTCoordsOn();
    reader.ReadAllFieldsOn();
    reader.Update();
    auto* const data = vtkDataSet::SafeDownCast(reader.GetOutputDataObject(0));
    if (text && data) {
        replace_stand_ins(*data->GetPointData());
        replace_stand_ins(*data->GetCellData());
    }
}

} // namespace isochron::index
