"""DICOM: a file for each slice, enhanced multi-frame, 4D by several clocks, and what is refused. Values are pydicom's own
reading, scaled as its header says."""
import numpy as np
import pydicom.uid
from pydicom.dataset import Dataset
from pydicom.sequence import Sequence
from pydicom.valuerep import DSfloat

from dicom_files import blank, new_series, save, sequence, stack
from manifest import done, expect, field, refuse

grid = dict(spacing=(0.5, 0.75, 2.0), origin=(-10, 20, 5))
turned = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]

# Types, rescale, byte order.
for kind in ("u1", "i1", "u2", "i2", "i4"):
    values = field(6, 5, 7, dtype=kind)
    expect(stack(f"{kind}.dcm", values, new_series()), values, direction=turned, **grid)
values = field(5, 6, 4, dtype="i2")
expect(stack("ct", values, new_series(), Modality="CT", RescaleSlope=2, RescaleIntercept=-1024), 2.0 * values - 1024, **grid)


def big(data, z):
    data.file_meta.TransferSyntaxUID = pydicom.uid.ExplicitVRBigEndian
    data.is_little_endian = False
    data.PixelData = np.frombuffer(data.PixelData, "<i2").astype(">i2").tobytes()


def implicit(data, z):
    data.file_meta.TransferSyntaxUID = pydicom.uid.ImplicitVRLittleEndian
    data.is_implicit_VR = True


expect(stack("big.dcm", values, new_series(), big), values, **grid)
wide = field(4, 5, 3, dtype="i4")


def big4(data, z):
    big(data, z)
    data.PixelData = wide[z].astype(">i4").tobytes()


expect(stack("big4.dcm", wide, new_series(), big4), wide, **grid)
expect(stack("implicit.dcm", values, new_series(), implicit), values, **grid)


def run_length(data, z):
    data.compress(pydicom.uid.RLELossless)


expect(stack("rle.dcm", values, new_series(), run_length), values, **grid)


def twelve(data, z):
    """12 bits of 16, others set."""
    data.BitsStored, data.HighBit = 12, 11
    stored = np.frombuffer(data.PixelData, "<i2")
    data.PixelData = ((stored.astype("u2") & 0xFFF) | 0x3000).astype("<u2").tobytes()


small = field(5, 6, 4, dtype="i2") >> 4
expect(stack("twelve.dcm", small, new_series(), twelve), small, **grid)


# Each slice with a slope of its own, as in PET.
def own(data, z):
    data.RescaleSlope, data.RescaleIntercept, data.Units = 0.5 + z, z, "BQML"


expect(stack("pet.dcm", values, new_series(), own),
       (values * (0.5 + np.arange(5))[:, None, None] + np.arange(5)[:, None, None]).astype("f4"), **grid)


# Multiples of a distance are missing slices; a tilted gantry is refused.
def gap(data, z):
    data.ImagePositionPatient = [0, 0, [0, 1, 2, 4, 5][z]]


def tilted(data, z):
    data.ImagePositionPatient = [0, 0.4 * z, 2.0 * z]


refuse(stack("gap.dcm", values, new_series(), gap), "slices are missing")
refuse(stack("tilted.dcm", values, new_series(), tilted), "shifted sideways, by 11.3 degrees")
refuse(stack("mosaic.dcm", values[:2], new_series(), ImageType=["ORIGINAL", "PRIMARY", "M", "MOSAIC"]), "mosaic")
refuse(stack("lut.dcm", field(2, 3, 3, dtype="u1"), new_series(), PhotometricInterpretation="PALETTE COLOR"),
       "PhotometricInterpretation PALETTE COLOR")

# Steps in time, by several clocks. Names and numbers are in no order.
moving = field(3, 4, 5, 6, dtype="u2")
clocks = {
    "trigger": (lambda data, t: setattr(data, "TriggerTime", DSfloat(30.5 * t + 2)), [2, 32.5, 63]),
    "position": (lambda data, t: setattr(data, "TemporalPositionIdentifier", t + 1), [1, 2, 3]),
    "acquired": (lambda data, t: setattr(data, "AcquisitionTime", f"0959{58 + t:02d}.250" if t < 2 else "100000.750"),
                 [0, 1, 2.5]),
}
for name, (clock, times) in clocks.items():
    series, names = new_series(), []
    for t in (2, 0, 1):
        def change(data, z):
            clock(data, t)
            data.InstanceNumber = 100 - 10 * t + z
        names += stack(f"{name}{t}.dcm", moving[t], series, change)
    expect(names, moving, times=times, **grid)
series = new_series()
refuse(stack("a.dcm", moving[0], series) + stack("b.dcm", moving[1][:3], series), "images at its place")
refuse(stack("c.dcm", moving[0], series) + stack("d.dcm", moving[1], series), "that neither time nor number tells apart")

# Several volumes in a folder are listed; echoes are no times.
series = new_series()
echoes = stack("e1.dcm", moving[0], series, EchoTime=2.5) + stack("e2.dcm", moving[1], series, EchoTime=5)
refuse(echoes, "echo time 2.5 ms")
expect(echoes, moving[1], array="echo time 5 ms", **grid)
two = stack("s1.dcm", moving[0], new_series(), SeriesDescription="thorax") + \
    stack("s2.dcm", moving[1], new_series(), SeriesDescription="head")
refuse(two, "3 head")
expect(two, moving[0], array="3 thorax", **grid)

# A description in Latin-1, of which UTF-8 is made.
named = stack("n1.dcm", moving[0], new_series(), SpecificCharacterSet="ISO_IR 100", SeriesDescription="Schädel") + \
    stack("n2.dcm", moving[1], new_series(), SpecificCharacterSet="ISO_IR 192", SeriesDescription="Füße")
expect(named, moving[0], array="3 Schädel", **grid)
expect(named, moving[1], array="3 Füße", **grid)

# Colors.
colors = field(3, 4, 5, 3, dtype="u1")
expect(stack("rgb.dcm", colors, new_series()), colors[..., 1], component="1", **grid)


def planar(data, z):
    data.PlanarConfiguration = 1
    data.PixelData = np.ascontiguousarray(np.moveaxis(colors[z], -1, 0)).tobytes()


expect(stack("planar.dcm", colors, new_series(), planar), colors[..., 2], component="2", **grid)


# One file: enhanced, with frames in no order, two steps in time; and the older ways.
def enhanced(name, change=lambda frame, t, z: None, compress=False):
    frames = [(t, z) for z in (2, 0, 3, 1) for t in (1, 0)]
    data = blank(np.stack([moving[t][z] for t, z in frames]), new_series())
    shared = Dataset()
    shared.PixelMeasuresSequence = sequence(PixelSpacing=[0.75, 0.5], SliceThickness=2)
    shared.PlaneOrientationSequence = sequence(ImageOrientationPatient=[1, 0, 0, 0, 1, 0])
    shared.PixelValueTransformationSequence = sequence(RescaleSlope=3, RescaleIntercept=-1, RescaleType="US")
    data.SharedFunctionalGroupsSequence = Sequence([shared])
    groups = []
    for t, z in frames:
        group = Dataset()
        group.PlanePositionSequence = sequence(ImagePositionPatient=[-10, 20, 5 + 2 * z])
        group.FrameContentSequence = sequence(TemporalPositionIndex=t + 1)
        change(group, t, z)
        groups.append(group)
    data.PerFrameFunctionalGroupsSequence = Sequence(groups)
    if compress:
        data.compress(pydicom.uid.RLELossless)
    return save(data, name)


expect(enhanced("enhanced.dcm"), 3.0 * moving[:2] - 1, times=[1, 2], **grid)
expect(enhanced("enhanced_rle.dcm", compress=True), 3.0 * moving[:2] - 1, times=[1, 2], **grid)


def cardiac(group, t, z):
    group.CardiacSynchronizationSequence = sequence(NominalCardiacTriggerDelayTime=12.5 * t + 1)


expect(enhanced("cardiac.dcm", cardiac), 3.0 * moving[:2] - 1, times=[1, 13.5], **grid)
dose = blank(moving[0].astype("u4"), new_series(), Modality="RTDOSE", DoseGridScaling=0.25, DoseUnits="GY",
             PixelSpacing=[0.75, 0.5], ImagePositionPatient=[-10, 20, 5], ImageOrientationPatient=[1, 0, 0, 0, 1, 0],
             GridFrameOffsetVector=[0, 2, 4, 6])
expect(save(dose, "dose.dcm"), moving[0] * 0.25, **grid)
nuclear = blank(moving[0], new_series(), Modality="NM", PixelSpacing=[0.75, 0.5], SpacingBetweenSlices=-2)
nuclear.DetectorInformationSequence = sequence(ImagePositionPatient=[-10, 20, 11],
                                               ImageOrientationPatient=[1, 0, 0, 0, 1, 0])
expect(save(nuclear, "nuclear.dcm"), moving[0][::-1], **grid)
plain = blank(moving[0], new_series(), PixelSpacing=[0.75, 0.5], SpacingBetweenSlices=2)
expect(save(plain, "plain.dcm"), moving[0], spacing=(0.5, 0.75, 2))

# What is no image is passed over, unless there is nothing else.
report = blank(moving[0][0], new_series())
for name in ("Rows", "Columns", "PixelData"):
    delattr(report, name)
expect(stack("with.dcm", moving[0], new_series()) + [save(report, "report.dcm")], moving[0], **grid)
refuse("report.dcm", "holds no image")
done()
