"""DICOM: what each image, frame or tile stands for. Statements of time by containers, vectors of older files, films, mosaics,
phases in series of their own, positions as scanners round them. Expected values are numpy's."""
import os
import struct

import numpy as np
import pydicom.uid
from pydicom.dataset import Dataset
from pydicom.sequence import Sequence
from pydicom.tag import Tag
from pydicom.valuerep import DSfloat

from dicom_files import blank, new_series, save, sequence, stack
from manifest import done, expect, field, path, refuse

grid = dict(spacing=(0.5, 0.75, 2.0), origin=(-10, 20, 5))
moving = field(3, 4, 5, 6, dtype="u2")
steps, layers = range(3), range(4)
count = 0


def named(kind):
    global count
    count += 1
    return f"{kind}{count}.dcm"


# ---- Statements of time, in each container that can make them: [the tags of step t], times, unit, what the note says.
def clock(day, seconds):
    """A date and a time of the day."""
    return f"202001{day:02d}", f"{seconds // 3600:02d}{seconds // 60 % 60:02d}{seconds % 60:02d}.250000"


midnight = [clock(1, 86370), clock(2, 0), clock(2, 30)]
late = [0, 30, 60]


def dated(date, time, days=True, form=lambda d, t: (d, t)):
    def tags(t):
        d, s = form(*midnight[t])
        return {**({date: d} if days is True else {date: days} if days else {}), time: s}
    return tags


def old(d, t):
    return f"{d[:4]}.{d[4:6]}.{d[6:]}", f"{t[:2]}:{t[2:4]}:{t[4:]}"


position = {"TemporalPositionIdentifier": [7, 8, 9]}


def at(tags):
    return lambda t: {name: value[t] if isinstance(value, list) and len(value) == 3 else value for name, value in tags.items()}


classic = {
    "trigger": (at({"TriggerTime": [2.5, 33, 63]}), [2.5, 33, 63], "ms", "by TriggerTime"),
    "reference": (at({"FrameReferenceTime": [500, 2000.5, 9000]}), [500, 2000.5, 9000], "ms", "by FrameReferenceTime"),
    "position": (at(position), [7, 8, 9], "", "by TemporalPositionIdentifier"),
    "resolution": (at({**position, "TemporalResolution": 250}), [1750, 2000, 2250], "ms", "times by TemporalResolution"),
    "position and clock": (lambda t: {**at(position)(t), **dated("AcquisitionDate", "AcquisitionTime")(t)}, late, "s",
                           "by TemporalPositionIdentifier, times by AcquisitionTime"),
    "durations": (at({**position, "ActualFrameDuration": ["500", "1500", "700"]}), [0, 500, 2000], "ms",
                  "times by ActualFrameDuration"),
    "repetition": (at({**position, "ScanningSequence": "EP", "RepetitionTime": 2200}), [0, 2200, 4400], "ms",
                   "times by RepetitionTime"),
    "no planar scan": (at({**position, "ScanningSequence": "GR", "RepetitionTime": 4.5}), [7, 8, 9], "",
                       "by TemporalPositionIdentifier"),
    "moment": (lambda t: {"AcquisitionDateTime": "".join(midnight[t]) + "+0100"}, late, "s", "by AcquisitionDateTime"),
    "midnight": (dated("AcquisitionDate", "AcquisitionTime"), late, "s", "by AcquisitionTime"),
    "old spelling": (dated("AcquisitionDate", "AcquisitionTime", form=old), late, "s", "by AcquisitionTime"),
    "first date": (dated("AcquisitionDate", "AcquisitionTime", days="20200101"), late, "s", "passes midnight"),
    "hidden date": (dated("AcquisitionDate", "AcquisitionTime", days="***"), late, "s", "passes midnight"),
    "no date": (dated("", "AcquisitionTime", days=False), late, "s", "passes midnight"),
    "content": (dated("ContentDate", "ContentTime"), late, "s", "by ContentTime"),
    "content, no date": (dated("", "ContentTime", days=False), late, "s", "passes midnight"),
    "series": (dated("SeriesDate", "SeriesTime"), late, "s", "by SeriesTime"),
    "image index": (lambda t: {"ImageIndex": None}, [0, 1, 2], "", "by ImageIndex alone"),
    "acquisition": (at({"AcquisitionNumber": [3, 5, 9]}), [0, 1, 2], "", "by AcquisitionNumber alone"),
    "fMRI": (at({"AcquisitionNumber": [3, 5, 9], "ScanningSequence": "EP", "RepetitionTime": 800}), [0, 800, 1600], "ms",
             "times by RepetitionTime"),
    "number": (lambda t: {}, [0, 1, 2], "", "by InstanceNumber alone"),
    "heartbeats": (lambda t: {"TriggerTime": [603.5, 601, 602][t], **dated("AcquisitionDate", "AcquisitionTime")(t)}, late, "s",
                   "by AcquisitionTime"),
}
for name, (tags, times, unit, note) in classic.items():
    series, names = new_series(), []
    for t in (1, 2, 0):
        def change(data, z):
            data.InstanceNumber = 1 + 4 * t + z
            for tag, value in tags(t).items():
                if tag == "ImageIndex":
                    value = 1 + 4 * t + z
                setattr(data, tag, DSfloat(value) if isinstance(value, float) else value)
        names += stack(named("classic"), moving[t], series, change)
    expect(names, moving, times=times, unit=unit, note=note, **grid)

# The same in enhanced files: one with all frames, or one for each time.
groups = {
    "offset": ("TemporalPositionSequence", at({"TemporalPositionTimeOffset": [0.5, 2, 4.25]}), [0.5, 2, 4.25], "s",
               "by TemporalPositionTimeOffset"),
    "heart": ("CardiacSynchronizationSequence", at({"NominalCardiacTriggerDelayTime": [1, 13.5, 40]}), [1, 13.5, 40], "ms",
              "by NominalCardiacTriggerDelayTime"),
    "breath": ("RespiratorySynchronizationSequence", at({"NominalRespiratoryTriggerDelayTime": [1, 13.5, 40]}), [1, 13.5, 40],
               "ms", "by NominalRespiratoryTriggerDelayTime"),
    "heart's phase": ("CardiacSynchronizationSequence", at({"NominalPercentageOfCardiacPhase": [10, 45, 70]}), [10, 45, 70], "%",
                      "by NominalPercentageOfCardiacPhase"),
    "breath's phase": ("RespiratorySynchronizationSequence", at({"NominalPercentageOfRespiratoryPhase": [0, 50, 70]}),
                       [0, 50, 70], "%", "by NominalPercentageOfRespiratoryPhase"),
    "index": ("FrameContentSequence", at({"TemporalPositionIndex": [1, 2, 3]}), [1, 2, 3], "", "by TemporalPositionIndex"),
    "index and clock": ("FrameContentSequence",
                        lambda t: {"TemporalPositionIndex": t + 1, "FrameAcquisitionDateTime": "".join(midnight[t])}, late, "s",
                        "by TemporalPositionIndex, times by FrameAcquisitionDateTime"),
    "one index": ("FrameContentSequence",
                  lambda t: {"TemporalPositionIndex": 1, "FrameAcquisitionDateTime": "".join(midnight[t])}, late, "s",
                  "by FrameAcquisitionDateTime"),
    "reference": ("FrameContentSequence", lambda t: {"FrameReferenceDateTime": "".join(midnight[t])}, late, "s",
                  "by FrameReferenceDateTime"),
    "number": ("FrameContentSequence", at({"FrameAcquisitionNumber": [2, 4, 8]}), [0, 1, 2], "",
               "by FrameAcquisitionNumber alone"),
    "gradients": ("MRDiffusionSequence", at({"DiffusionBValue": 1000.0}), [0, 1, 2], "",
                  "by DiffusionGradientOrientation, which is no time"),
}


def enhanced(frames, values, group, tags, series, dimensions=None):
    """dimensions: the indices of frame (t, z), and what they point to."""
    data = blank(np.stack([values[t][z] for t, z in frames]), series)
    shared = Dataset()
    shared.PixelMeasuresSequence = sequence(PixelSpacing=[0.75, 0.5], SliceThickness=2)
    shared.PlaneOrientationSequence = sequence(ImageOrientationPatient=[1, 0, 0, 0, 1, 0])
    data.SharedFunctionalGroupsSequence = Sequence([shared])
    items = []
    for t, z in frames:
        item = Dataset()
        item.PlanePositionSequence = sequence(ImagePositionPatient=[-10, 20, 5 + 2 * z])
        item.FrameContentSequence = sequence(StackID="1", InStackPositionNumber=z + 1)
        if group in item:
            for tag, value in tags(t).items():
                setattr(getattr(item, group)[0], tag, value)
        else:
            setattr(item, group, sequence(**tags(t)))
        if dimensions:
            item.FrameContentSequence[0].DimensionIndexValues = [z + 1, t + 1]
        items.append(item)
    data.PerFrameFunctionalGroupsSequence = Sequence(items)
    if dimensions:
        data.DimensionIndexSequence = Sequence([sequence(DimensionIndexPointer=pointer)[0] for pointer in dimensions])
    return data


for name, (group, tags, times, unit, note) in groups.items():
    dimensions = [Tag("InStackPositionNumber"), Tag("DiffusionGradientOrientation")] if name == "gradients" else None
    series = new_series()
    together = enhanced([(t, z) for z in (2, 0, 3, 1) for t in (1, 0, 2)], moving, group, tags, series, dimensions)
    expect(save(together, named("enhanced")), moving, times=times, unit=unit, note=note, **grid)
    if dimensions:
        continue
    apart = [save(enhanced([(t, z) for z in (2, 0, 3, 1)], moving, group, tags, series), named("apart")) for t in (2, 0, 1)]
    expect(apart, moving, times=times, unit=unit, note=note, **grid)

# Ultrasound places its volumes in a space of its own.
echo = enhanced([(t, z) for z in (2, 0, 3, 1) for t in (1, 0, 2)], moving, *groups["offset"][:2], new_series())
echo.SharedFunctionalGroupsSequence[0].PlaneOrientationVolumeSequence = sequence(ImageOrientationVolume=[1.0, 0, 0, 0, 1, 0])
del echo.SharedFunctionalGroupsSequence[0].PlaneOrientationSequence
for item in echo.PerFrameFunctionalGroupsSequence:
    item.PlanePositionVolumeSequence = sequence(ImagePositionVolume=[float(v) for v in
                                                                     item.PlanePositionSequence[0].ImagePositionPatient])
    del item.PlanePositionSequence
expect(save(echo, "echo.dcm"), moving, times=[0.5, 2, 4.25], unit="s", **grid)

# Dimensions that are volumes of their own.
for group, tag, values, chosen in [("SegmentIdentificationSequence", "ReferencedSegmentNumber", [1, 2, 3], "segment 2"),
                                   ("MREchoSequence", "EffectiveEchoTime", [2.5, 5.0, 7.5], "echo time 5 ms"),
                                   ("MRImageFrameTypeSequence", "ComplexImageComponent", ["MAGNITUDE", "PHASE", "REAL"],
                                    "component PHASE"),
                                   ("CTXRayDetailsSequence", "KVP", [80, 100, 140], "voltage 100 kV"),
                                   ("FrameContentSequence", "StackID", ["1", "2", "3"], "stack 2"),
                                   ("MRVelocityEncodingSequence", "VelocityEncodingDirection",
                                    [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "velocity direction 0 1 0")]:
    name = save(enhanced([(t, z) for t in steps for z in layers], moving, group, lambda t: {tag: values[t]}, new_series()),
                named("volumes"))
    refuse(name, chosen)
    expect(name, moving[1], array=chosen, **grid)

# ---- Vectors of older files with many frames.
nuclear = dict(Modality="NM", PixelSpacing=[0.75, 0.5], SpacingBetweenSlices=2)
flat = moving.reshape(12, 5, 6)
slots = [t + 1 for t in steps for z in layers]
slices = [z + 1 for t in steps for z in layers]
place = dict(DetectorInformationSequence=sequence(ImagePositionPatient=[-10, 20, 5], ImageOrientationPatient=[1, 0, 0, 0, 1, 0]))
gated = dict(GatedInformationSequence=sequence(DataInformationSequence=sequence(FrameTime=40)))
gated_interval = dict(NumberOfTimeSlots=3, GatedInformationSequence=sequence(DataInformationSequence=sequence(NominalInterval=900)))
phases = dict(PhaseInformationSequence=Sequence([
    sequence(ActualFrameDuration=1000, NumberOfFramesInPhase=2, PhaseDelay=50)[0],
    sequence(ActualFrameDuration=5000, NumberOfFramesInPhase=1, PhaseDelay=0)[0]]))
in_phases = dict(PhaseVector=[1] * 8 + [2] * 4, TimeSliceVector=[1] * 4 + [2] * 4 + [1] * 4)
at_zero = dict(spacing=(0.5, 0.75, 2.0))
for name, tags, frames, times, unit, where in [
        ("slots", dict(TimeSlotVector=slots, SliceVector=slices), flat, [1, 2, 3], "", at_zero),
        ("slots in place", dict(TimeSlotVector=slots, SliceVector=slices, **place), flat, [1, 2, 3], "", grid),
        ("slices without a vector", dict(TimeSlotVector=slots, **place), flat, [1, 2, 3], "", grid),
        ("slots with their time", dict(TimeSlotVector=slots, SliceVector=slices, **gated, **place), flat, [0, 40, 80], "ms", grid),
        ("slots of an interval", dict(TimeSlotVector=slots, SliceVector=slices, **gated_interval), flat, [0, 300, 600], "ms",
         at_zero),
        ("slices slowest", dict(TimeSlotVector=[1, 2, 3] * 4, SliceVector=[1] * 3 + [2] * 3 + [3] * 3 + [4] * 3, **place),
         moving.transpose(1, 0, 2, 3).reshape(12, 5, 6), [1, 2, 3], "", grid),
        ("slices down", dict(TimeSlotVector=slots, SliceVector=[5 - z for z in slices], **place), moving[:, ::-1].reshape(12, 5, 6),
         [1, 2, 3], "", grid),
        ("numbers alone", dict(NumberOfTimeSlots=3, NumberOfSlices=4, **place), flat, [1, 2, 3], "", grid),
        ("one RR interval", dict(RRIntervalVector=[1] * 12, TimeSlotVector=slots, SliceVector=slices, EnergyWindowVector=[1] * 12,
                                 DetectorVector=[1] * 12, **place), flat, [1, 2, 3], "", grid),
        ("time slices", dict(TimeSliceVector=slots, SliceVector=slices), flat, [1, 2, 3], "", at_zero),
        ("phases", dict(SliceVector=slices, **in_phases), flat, None, "", at_zero),
        ("phases with times", dict(SliceVector=slices, **in_phases, **phases), flat, [50, 1050, 2050], "ms", at_zero)]:
    for pointers in (["TimeSlotVector", "SliceVector"], None):
        data = blank(frames, new_series(), **{**nuclear, **tags})
        if pointers:
            data.FrameIncrementPointer = [Tag(pointer) for pointer in pointers]
        expect(save(data, named("vectors")), moving, times=times, unit=unit, note="steps by ", **where)
down = blank(flat, new_series(), **{**nuclear, "SpacingBetweenSlices": -2}, TimeSlotVector=slots, SliceVector=slices, **place)
expect(save(down, named("vectors")), moving[:, ::-1], times=[1, 2, 3], spacing=(0.5, 0.75, 2), origin=(-10, 20, -1))
for vector, chosen in [("RRIntervalVector", "RR interval 2"), ("EnergyWindowVector", "energy window 2"),
                       ("DetectorVector", "detector 2"), ("RotationVector", "rotation 2")]:
    data = blank(flat, new_series(), **nuclear, **{vector: slots}, SliceVector=slices, **place)
    name = save(data, named("volumes"))
    refuse(name, chosen)
    expect(name, moving[1], array=chosen, **grid)
both = blank(np.concatenate([flat, flat[::-1]]), new_series(), **nuclear, RRIntervalVector=[1] * 12 + [2] * 12,
             TimeSlotVector=slots * 2, SliceVector=slices * 2, **place)
expect(save(both, "both.dcm"), moving[::-1, ::-1], array="RR interval 2", times=[1, 2, 3], **grid)
for vector in ("AngularViewVector", "FramePrimaryAngleVector"):
    values = [float(i) for i in range(12)] if vector.startswith("Frame") else list(range(1, 13))
    refuse(save(blank(flat, new_series(), **nuclear, **{vector: values}), named("views")), f"directions of view ({vector})")
refuse(save(blank(flat, new_series(), Modality="SM", TotalPixelMatrixColumns=24, TotalPixelMatrixRows=15), "tiles.dcm"),
       "12 tiles of one picture")

# ---- Directions of diffusion: volumes, whatever their clocks say.
def private(data, group, element, creator, kind, value):
    data.private_block(group, creator, create=True).add_new(element, kind, value)


def gradient_of(turn):
    inner, outer = Dataset(), Dataset()
    inner.DiffusionGradientOrientation = list(map(float, turn))
    outer.DiffusionGradientDirectionSequence = Sequence([inner])
    return Sequence([outer])


turns = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
makers = {
    "standard": lambda data, turn: data.__setattr__("DiffusionGradientOrientation", list(map(float, turn))),
    "group": lambda data, turn: data.__setattr__("MRDiffusionSequence", gradient_of(turn)),
    "Siemens": lambda data, turn: private(data, 0x19, 0x0e, "SIEMENS MR HEADER", "FD", list(map(float, turn))),
    "GE": lambda data, turn: [private(data, 0x19, 0xbb + i, "GEMS_ACQU_01", "DS", str(part)) for i, part in enumerate(turn)],
    "Philips": lambda data, turn: [private(data, 0x2005, 0xb0 + i, "Philips MR Imaging DD 001", "FL", float(part))
                                   for i, part in enumerate(turn)],
}


for maker, say in makers.items():
    series, names = new_series(), []
    for t in steps:
        for z in layers:
            data = blank(moving[t, z][None], series, Modality="MR", AcquisitionNumber=t + 1, AcquisitionTime=f"1000{t:02d}",
                         PixelSpacing=[0.75, 0.5], ImageOrientationPatient=[1, 0, 0, 0, 1, 0],
                         ImagePositionPatient=[-10, 20, 5 + 2 * z], DiffusionBValue=1000.0)
            say(data, turns[t])
            names.append(save(data, named("dwi")))
    refuse(names, "gradient 0 1 0")
    expect(names, moving[1], array="gradient 0 1 0", **grid)

# ---- Films: frames in time, of one slice each.
times = [Tag("FrameTime")]
for name, tags, said in [
        ("ultrasound", dict(Modality="US", FrameTime=33.3, FrameIncrementPointer=times), "steps by FrameTime"),
        ("uneven", dict(Modality="XA", FrameTimeVector=[0] + [30, 31, 40] * 3 + [29, 35], FrameIncrementPointer=[Tag("FrameTimeVector")]),
         "steps by FrameTimeVector"),
        ("no pointer", dict(Modality="US", CineRate=25), "steps by FrameTime"),
        ("nothing", dict(Modality="US"), "steps by the number of the frame"),
        ("planar", dict(Modality="NM", TimeSlotVector=list(range(1, 13)), FrameIncrementPointer=[Tag("TimeSlotVector")]),
         "steps by TimeSlotVector")]:
    data = save(blank(flat, new_series(), PixelSpacing=[0.75, 0.5], **tags), named("film"))
    refuse(data, f"a film, 12 frames of one slice ({said}")
    expect(data, flat, spacing=(0.5, 0.75, 3), spacing_given=[0.5, 0.75, 3], note="they are taken for slices")
expect(save(blank(flat, new_series(), **{**nuclear, "Modality": "US"}, FrameTime=33), named("solid")), flat,
       spacing=(0.5, 0.75, 2), note="they are taken for slices")
series, cine = new_series(), []
for t in range(12):  # a file for each frame, at one place
    cine.append(save(blank(flat[t], series, PixelSpacing=[0.75, 0.5], TriggerTime=30 * t, ImagePositionPatient=[-10, 20, 5],
                           ImageOrientationPatient=[1, 0, 0, 0, 1, 0]), named("cine")))
refuse(cine, "a film, 12 frames of one slice (steps by TriggerTime")
expect(cine, flat, spacing=(0.5, 0.75, 3), origin=(-10, 20, 5), spacing_given=[0.5, 0.75, 3], note="they are taken for slices")
offsets = blank(flat, new_series(), Modality="RTDOSE", PixelSpacing=[0.75, 0.5], ImagePositionPatient=[-10, 20, 5],
                ImageOrientationPatient=[1, 0, 0, 0, 1, 0], GridFrameOffsetVector=[-2 * i for i in range(12)],
                FrameIncrementPointer=[Tag("GridFrameOffsetVector")])
expect(save(offsets, "offsets.dcm"), flat[::-1], spacing=(0.5, 0.75, 2), origin=(-10, 20, 5 - 22))

# Slices without positions, at their SliceLocation.
series, names = new_series(), []
for t in steps:
    def located(data, z):
        del data.ImagePositionPatient
        data.SliceLocation, data.TriggerTime = DSfloat(3.5 * z), 10 * t + 5
    names += stack(named("located"), moving[t], series, located)
expect(names, moving, spacing=(0.5, 0.75, 3.5), times=[5, 15, 25], unit="ms")


# ---- Mosaics.
def csa(count, normal):
    """The header of Siemens, in which each element has values of text."""
    def element(name, vr, values):
        # The program writes more items than there are values.
        text = struct.pack("<64si4siii", name.encode(), len(values), vr.encode(), {"US": 10, "FD": 4}[vr], 6, 77)
        for value in [*values, *[""] * (6 - len(values))]:
            raw = value.encode() + b"\0" if value else b""
            text += struct.pack("<iiii", len(raw), len(raw), 77, len(raw)) + raw + b"\0" * (-len(raw) % 4)
        return text
    return b"SV10\4\3\2\1" + struct.pack("<II", 2, 77) + element("NumberOfImagesInMosaic", "US", [str(count)]) + \
        element("SliceNormalVector", "FD", [f"{v:.8f}" for v in normal])


def mosaic(values, series, across, down, **tags):
    picture = np.zeros((down * 5, across * 6), values.dtype)
    for z, tile in enumerate(values):
        y, x = z // across * 5, z % across * 6
        picture[y:y + 5, x:x + 6] = tile
    data = blank(picture, series, PixelSpacing=[0.75, 0.5], SpacingBetweenSlices=2, SliceThickness=1.5,
                 ImageOrientationPatient=[1, 0, 0, 0, 1, 0], **tags)
    return data


def of_siemens(values, series, number, normal=(0, 0, 1), z=5, headers="image"):
    across = int(np.ceil(np.sqrt(len(values))))
    data = mosaic(values, series, across, across, ImageType=["ORIGINAL", "PRIMARY", "M", "ND", "MOSAIC"],
                  Manufacturer="SIEMENS", ScanningSequence="EP", RepetitionTime=1500, AcquisitionNumber=number,
                  # As far from the first tile as the middle of the whole is from its own.
                  ImagePositionPatient=[-10 - 6 * 0.5 * (across - 1) / 2, 20 - 5 * 0.75 * (across - 1) / 2, z])
    if headers == "image":
        block = data.private_block(0x29, "SIEMENS CSA HEADER", create=True)
        block.add_new(0x10, "OB", csa(len(values), normal))
    if headers == "number":
        data.private_block(0x19, "SIEMENS MR HEADER", create=True).add_new(0x0A, "US", len(values))
    return data


several = field(3, 7, 5, 6, dtype="u2")
tile = dict(spacing=(0.5, 0.75, 2), origin=(-10, 20, 5))
for headers in ("image", "number"):
    series = new_series()
    names = [save(of_siemens(several[t], series, t + 1, headers=headers), named("mosaic")) for t in (2, 0, 1)]
    expect(names, several, times=[0, 1500, 3000], unit="ms", note="times by RepetitionTime", **tile)
turned = [save(of_siemens(several[t], "1.2.3.9", t + 1, normal=(0, 0, -1), z=17), named("mosaic")) for t in steps]
expect(turned, several[:, ::-1], times=[0, 1500, 3000], **tile)
packed = of_siemens(several[0], new_series(), 1)
packed.compress(pydicom.uid.RLELossless)
expect(save(packed, named("mosaic")), several[0], **tile)
older = of_siemens(several[0], new_series(), 1, headers="number")
older.file_meta.TransferSyntaxUID, older.is_implicit_VR = pydicom.uid.ImplicitVRLittleEndian, True
expect(save(older, named("mosaic")), several[0], **tile)
refuse(save(of_siemens(several[0], new_series(), 1, headers=""), named("mosaic")), "says nothing of their number: `dcm2niix")
uneven = of_siemens(several[0], new_series(), 1)
uneven.Columns, uneven.Rows = 27, 10
refuse(save(uneven, named("mosaic")), "that says it has 7 slices: `dcm2niix")


def of_united_imaging(values, series, t):
    data = mosaic(values, series, 3, 3 if len(values) > 6 else 2, ImageType=["ORIGINAL", "PRIMARY", "M", "VFRAME"],
                  Manufacturer="UIH", ContentTime="134057")
    block = data.private_block(0x65, "Image Private Header", create=True)
    block.add_new(0x50, "DS", str(len(values)))
    block.add_new(0x51, "SQ", Sequence([sequence(AcquisitionDateTime=f"20180925235958.{t}{(z * 3) % 7}0000" if t < 2 else
                                                 f"20180926000001.2{(z * 3) % 7}0000",
                                                 ImagePositionPatient=[-10, 20, 5 + 2 * z])[0] for z in range(len(values))]))
    return data


for number in (7, 5):
    series = new_series()
    names = [save(of_united_imaging(several[t][:number], series, t), named("united")) for t in (1, 2, 0)]
    expect(names, several[:, :number], times=[0, 0.1, 3.2], unit="s", note="by AcquisitionDateTime", **tile)


# ---- Phases of one scan, a series each.
def scan(descriptions, order=(0, 1, 2), change=lambda data, t: None, where=lambda t: (-10, 20, 5)):
    names = []
    for t in order:
        def of_phase(data, z):
            data.SeriesNumber = 10 + t
            data.SeriesDescription = descriptions[t]
            change(data, t)
        names += stack(named("phase"), moving[t], new_series(), of_phase, origin=where(t), Modality="CT")
    return names


for descriptions, times, unit in [
        (["Gated 0%", "Gated 10%", "Gated 20%"], [0, 10, 20], "%"),
        (["Gated, 0.0%A", "Gated, 33.3%A", "Gated, 66.7%A"], [0, 33.3, 66.7], "%"),
        (["T=5%", "T=15%", "T=95%"], [5, 15, 95], "%"),
        (["4DCT 0% Ex", "4DCT 25 % In", "4DCT 50% inhale"], [0, 25, 50], "%"),
        (["phase_1", "phase_2", "phase_10"], [1, 2, 10], ""),
        (["Ph1/Ax Dyn", "Ph2/Ax Dyn", "Ph3/Ax Dyn"], [1, 2, 3], "")]:
    for order in ((0, 1, 2), (2, 0, 1)):
        expect(scan(descriptions, order), moving, times=times, unit=unit, note="3 series are the phases of one scan", **grid)
names = scan(["Gated 0%", "Gated 10%", "Gated 20%"])
expect(names, moving[1], array="11 Gated 10%", **grid)
more = names + stack(named("average"), moving[0], new_series(), SeriesDescription="Average", Modality="CT")
refuse(more, "CT by phase (u16, 6 x 5, 12 images), ")
expect(more, moving, array="CT by phase", times=[0, 10, 20], unit="%", **grid)
refuse(scan(["Gated 0%", "Gated 10%", "Gated 10%"]), "choose one with --array")
refuse(scan(["B30f 0%", "B31f 10%", "B32f 20%"]), "choose one with --array")
refuse(scan(["soft", "lung", "bone"]), "choose one with --array")
refuse(scan(["Gated 0%", "Gated 10%", "Gated 20%"], where=lambda t: (-10, 20, 5 + 40 * t)), "choose one with --array")


def one_of_three(data, t):
    data.TemporalPositionIdentifier, data.NumberOfTemporalPositions = t + 1, 3
    data.AcquisitionDate, data.AcquisitionTime = midnight[t]


expect(scan(["dynamic"] * 3, (1, 0, 2), one_of_three), moving, times=late, unit="s", note="phases of one scan", **grid)


def commented(data, t):
    data.ImageComments = f"Phase {30 * t} %, best diastole"


expect(scan(["CorCTA"] * 3, (1, 0, 2), commented), moving, times=[0, 30, 60], unit="%", note="steps by phase", **grid)
names = []
for t in (2, 0, 1):
    folder = f"cine/phase_{t}"
    os.makedirs(path(folder))
    names += stack(f"{folder}/image", moving[t], new_series(), SeriesDescription="CT", SeriesNumber=t)
expect(names, moving, times=[0, 1, 2], note="steps by phase", **grid)
expect(["cine"], moving, times=[0, 1, 2], note="steps by phase", **grid)


def of_heart(data, t):
    data.NominalPercentageOfCardiacPhase = 40.0 + 5 * t


expect(scan(["CorCTA"] * 3, (1, 0, 2), of_heart), moving, times=[40, 45, 50], unit="%", note="NominalPercentageOfCardiacPhase",
       **grid)

# ---- Positions and directions as scanners write them, rounded: they are no tilt, no gap and no unevenness.
many = field(24, 5, 6, dtype="i2")
for turn in (0, 7.7, 30):
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    along = [1, 0, 0, 0, c, s]
    normal = np.cross(along[:3], along[3:])
    for pixel, spacing, digits in [(0.859375, 7, 1), (0.859375, 0.625, 1), (0.5, 3.3, 2), (0.46875, 1.25, 3)]:
        def written(tilt=0, skip=lambda z: z):
            """tilt: [mm] by which each slice is shifted along its columns."""
            series = new_series()

            def change(data, z):
                data.ImageOrientationPatient = [DSfloat(round(v, 6)) for v in along]
                there = np.array([-110.04, -100.4, -30.3]) + spacing * skip(z) * normal + tilt * z * np.array(along[3:])
                data.ImagePositionPatient = [DSfloat(round(float(v), digits)) for v in there]
            return stack(named("rounded"), many, series, change, spacing=(pixel, pixel, spacing))
        first = [round(v, digits) for v in (-110.04, -100.4, -30.3)]
        last = [round(float(v), digits) for v in np.array([-110.04, -100.4, -30.3]) + spacing * 23 * normal]
        exact = np.dot(np.subtract(last, first), np.cross([round(v, 6) for v in along[:3]], [round(v, 6) for v in along[3:]])) / 23
        expect(written(), many, spacing=(pixel, pixel, exact), origin=first,
               direction=[along[:3], along[3:], [float(v) for v in normal]])
        refuse(written(tilt=0.03 * spacing), "shifted sideways")
        refuse(written(skip=lambda z: z + (z > 11)), "slices are missing")
tilted = stack("gantry", many, new_series(), lambda data, z: setattr(data, "ImagePositionPatient", [0, 0.4 * z, 2.0 * z]),
               Modality="CT")
refuse(tilted, "a gantry tilted by 11.3 degrees")


def noisy(data, z):
    """Directions that differ in their last digits are those of one volume."""
    data.ImageOrientationPatient = [1, 0, 0, 0, DSfloat(0.995 - (z % 2) * 1e-6), DSfloat(0.0998749)]
    normal = np.cross([1, 0, 0], [0, 0.995, 0.0998749])
    data.ImagePositionPatient = [DSfloat(round(float(v), 4)) for v in np.array([-10, 20, 5]) + 2 * z * normal]


expect(stack("noisy", moving[0], new_series(), noisy), moving[0], spacing=(0.5, 0.75, 2), origin=(-10, 20, 5),
       direction=[[1, 0, 0], [0, 0.995, 0.0998749], [0, -0.0998749, 0.995]])
done()
