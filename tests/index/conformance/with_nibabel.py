"""NIfTI-1 and -2, pairs and Analyze 7.5 by nibabel."""
import gzip
import warnings

import nibabel
import numpy as np

from manifest import done, expect, field, path, refuse

warnings.simplefilter("ignore")
affine = np.array([[0, -2.0, 0, 5], [1.5, 0, 0, -7], [0, 0, 3.0, 11], [0, 0, 0, 1]])
where = dict(spacing=(1.5, 2, 3), origin=(5, -7, 11), direction=[[0, 1, 0], [-1, 0, 0], [0, 0, 1]])


def zyx(image):
    """As the library scales it, time first."""
    return np.transpose(image.get_fdata())


for name, kind, dtype, shape in [("a.nii", nibabel.Nifti1Image, "i2", (4, 5, 6)),
                                 ("b.nii.gz", nibabel.Nifti1Image, "f4", (4, 5, 6, 3)),
                                 ("c.nii", nibabel.Nifti2Image, "u2", (4, 5, 6, 2)),
                                 ("d.nii", nibabel.Nifti1Image, ">f8", (4, 5, 6))]:
    image = kind(field(*shape, dtype=dtype), affine)
    image.header["pixdim"][4] = 2.5
    image.header.set_xyzt_units("mm", "sec")
    nibabel.save(image, path(name))
    times = np.arange(shape[3]) * 2.5 if len(shape) == 4 else None
    expect(name, zyx(nibabel.load(path(name))), times=times, **where)

# A scaling: stored integers stay as they are.
image = nibabel.Nifti1Image(field(4, 5, 6, dtype="i2"), affine)
image.header.set_slope_inter(0.5, 10)
nibabel.save(image, path("scaled.nii"))
expect("scaled.nii", zyx(nibabel.load(path("scaled.nii"))), kind="rounded", **where)

# A fifth axis has components: of vectors, or of tensors over time.
for name, shape in [("vectors.nii", (4, 5, 6, 1, 3)), ("tensors.nii.gz", (4, 5, 6, 2, 6))]:
    image = nibabel.Nifti1Image(field(*shape, dtype="f4"), affine)
    image.header["pixdim"][4:6] = 2.5, 0.5
    image.header.set_xyzt_units("mm", "sec")
    nibabel.save(image, path(name))
    values = zyx(nibabel.load(path(name)))  # component, time, z, y, x
    times = np.arange(shape[3]) * 2.5 if shape[3] > 1 else None
    refuse(name, f"{shape[4]} components, choose one with --component 0 to {shape[4] - 1} or --component "
           "magnitude" + ("; --extra-axis-is-time reads them as steps" if shape[3] == 1 else ""))
    for component in (0, shape[4] - 1):
        expect(name, values[component], times=times, component=str(component), **where)
values = zyx(nibabel.load(path("vectors.nii")))[:, 0]
expect("vectors.nii", np.sqrt((values**2).sum(axis=0)), component="magnitude", kind="rounded", **where)
expect("vectors.nii", values, times=[0, 0.5, 1], extra_axis_is_time=True, **where)
image = nibabel.Nifti1Image(field(4, 5, 6, 1, 1, 2), affine)
nibabel.save(image, path("six.nii"))
refuse("six.nii", "6 dimensions, the 6th with 2 values")

# Directions of diffusion, as a file beside it says, are no times.
directions = field(7, 3, 4, 5)
for name, beside in [("dwi.nii.gz", "dwi.bval"), ("bvec.nii", "bvec.bvec")]:
    nibabel.save(nibabel.Nifti1Image(directions.transpose(3, 2, 1, 0), affine), path(name))
    with open(path(beside), "w") as out:
        out.write("0 1000 1000 1000 1000 1000 1000\n")
    refuse(name, "diffusion has 7 components, choose one with --component 0 to 6")
    expect(name, directions[3], component="3", note=f"{beside} is beside it", **where)
    expect(name, directions, extra_axis_is_time=True, **where)

# What an intent says of the fourth axis, in both versions: components, or still time.
for kind in (nibabel.Nifti1Image, nibabel.Nifti2Image):
    for code, count, what in [(1004, 9, "matrices"), (1005, 6, "symmetric matrices"), (1006, 3, "displacement vectors"),
                              (1007, 3, "vectors"), (1010, 4, "quaternions"), (2003, 3, "vectors of colors, RGB"),
                              (2004, 4, "vectors of colors, RGBA"), (2006, 3, "displacement vectors of FSL"),
                              (2016, 3, "coefficients of FSL"), (0, 3, ""), (3, 3, "statistics"), (1002, 3, "labels"),
                              (2001, 3, ""), (77, 3, "")]:
        name = f"intent_{kind.__name__}_{code}.nii"
        image = kind(field(4, 5, 6, count, dtype="f4"), affine)
        image.header["intent_code"], image.header["pixdim"][4] = code, 2.5
        image.header.set_xyzt_units("mm", "sec")
        nibabel.save(image, path(name))
        values, times = zyx(nibabel.load(path(name))), np.arange(count) * 2.5
        if 1004 <= code <= 1010 or code > 2001:
            refuse(name, f"{count} components, choose one with --component")
            expect(name, values[1], component="1", note=f"intent_code {code} ({what}): its fourth axis is not time", **where)
            expect(name, values, times=times, unit="s", extra_axis_is_time=True, **where)
        else:
            expect(name, values, times=times, unit="s", note=f"intent_code {code} ({what})" if what else None, **where)
for unit, said in [("ppm", "ppm"), ("hz", "Hz"), ("rads", "rad/s")]:
    image = nibabel.Nifti1Image(field(4, 5, 6, 3, dtype="f4"), affine)
    image.header["pixdim"][4] = 2.5
    image.header.set_xyzt_units("mm", unit)
    nibabel.save(image, path(f"spectrum_{unit}.nii"))
    expect(f"spectrum_{unit}.nii", zyx(nibabel.load(path(f"spectrum_{unit}.nii"))), times=[0, 2.5, 5], unit=said,
           note=f"fourth axis is in {said}, no time", **where)

# Pairs, either file of which may be given.
image = nibabel.Nifti1Pair(field(4, 5, 6, dtype="i2"), affine)
nibabel.save(image, path("pair.img"))
for name in ["pair.img", "pair.hdr"]:
    expect(name, zyx(nibabel.load(path("pair.img"))), **where)
for name, kind, dtype in [("plain", nibabel.AnalyzeImage, "u1"), ("spm", nibabel.Spm99AnalyzeImage, "i2"),
                          ("big", nibabel.AnalyzeImage, ">f4")]:
    image = kind(field(4, 5, 6, 2, dtype=dtype), None)
    if dtype[0] == ">":
        image = kind(field(4, 5, 6, 2), None, kind.header_class(endianness=">"))
        image.header.set_data_dtype(">f4")
    image.header.set_zooms((1.5, 2, 3, 1))
    nibabel.save(image, path(f"{name}.img"))
    got = nibabel.load(path(f"{name}.img"))
    for end in ["img", "hdr"]:
        expect(f"{name}.{end}", zyx(got), spacing=(1.5, 2, 3), kind="rounded")
with open(path("alone.img"), "wb") as f:
    f.write(bytes(100))
refuse("alone.img", "alone.img: its .hdr is not beside it")
nibabel.Nifti1Image(np.asarray(field(4, 5, 6)).transpose(2, 1, 0), np.eye(4)).to_filename(path("whole.nii"))
with open(path("whole.nii"), "rb") as file:
    whole = file.read()
for name, content in [("whole.img", whole), ("whole.dat", whole), ("packed.nii", gzip.compress(whole)), ("packed.img", gzip.compress(whole))]:
    with open(path(name), "wb") as file:
        file.write(content)
    expect(name, np.asanyarray(nibabel.load(path("whole.nii")).dataobj).transpose(2, 1, 0))
done()
