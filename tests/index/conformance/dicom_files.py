"""What the scripts share that write DICOM files with pydicom."""
import pydicom
import pydicom.uid
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.sequence import Sequence
from pydicom.valuerep import DSfloat

from manifest import path

series_number = 0


def new_series():
    global series_number
    series_number += 1
    return f"1.2.826.0.1.3680043.9.{series_number}"


def blank(values, series, **tags):
    """A data set with an image, or frames of one, in it: [y][x], [frame][y][x] or [y][x][rgb]."""
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.2"
    meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid(entropy_srcs=[series, str(tags)])
    meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
    data = FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128)
    data.is_little_endian, data.is_implicit_VR = True, False
    data.SOPClassUID, data.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
    data.SeriesInstanceUID = series
    data.SeriesNumber = 3
    data.SeriesDescription = "test"
    data.Modality = "MR"
    put(data, values)
    for name, value in tags.items():
        setattr(data, name, value)
    return data


def put(data, values):
    color = values.ndim == 3 and values.shape[-1] == 3
    data.Rows, data.Columns = values.shape[-3:-1] if color else values.shape[-2:]
    data.SamplesPerPixel = 3 if color else 1
    if color:
        data.PlanarConfiguration = 0
    data.PhotometricInterpretation = "RGB" if color else "MONOCHROME2"
    data.BitsAllocated = data.BitsStored = 8 * values.dtype.itemsize
    data.HighBit = data.BitsStored - 1
    data.PixelRepresentation = int(values.dtype.kind == "i")
    if values.ndim == 3 and not color:
        data.NumberOfFrames = values.shape[0]
    data.PixelData = values.tobytes()


def save(data, name):
    data.save_as(path(name), write_like_original=False)
    return name


def stack(name, values, series, change=lambda data, z: None, spacing=(0.5, 0.75, 2.0), origin=(-10, 20, 5), **tags):
    """A file for each slice, in shuffled order of names."""
    names = []
    for z in range(len(values)):
        data = blank(values[z], series, **tags)
        data.PixelSpacing = [DSfloat(spacing[1]), DSfloat(spacing[0])]
        data.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
        data.ImagePositionPatient = [origin[0], origin[1], origin[2] + spacing[2] * z]
        data.InstanceNumber = z + 1
        data.SliceThickness = 9
        change(data, z)
        names.append(save(data, f"{name}_{(z * 7 + 3) % 11}_{z}"))
    return names


def sequence(**tags):
    item = Dataset()
    for name, value in tags.items():
        setattr(item, name, value)
    return Sequence([item])
