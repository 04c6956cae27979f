"""Shows numbered PLY files as an animation in Blender, one file a frame:

    isochron export run42.isochron --isovalue 0.5 --format ply -o surfaces/
    blender --python blender_sequence.py -- surfaces/run42_*.ply
"""
import sys

import bpy


def load(path):
    """The object of a PLY file; Blender 4 has another importer than Blender 3."""
    before = set(bpy.data.objects)
    if "ply_import" in dir(bpy.ops.wm):
        bpy.ops.wm.ply_import(filepath=path)
    else:
        bpy.ops.import_mesh.ply(filepath=path)
    return (set(bpy.data.objects) - before).pop()


def show_in(frame, thing):
    """Hides an object in all frames but one."""
    for at, hidden in ((frame - 1, True), (frame, False), (frame + 1, True)):
        thing.hide_viewport = thing.hide_render = hidden
        thing.keyframe_insert("hide_viewport", frame=at)
        thing.keyframe_insert("hide_render", frame=at)


files = sorted(sys.argv[sys.argv.index("--") + 1:])
for number, file in enumerate(files, start=1):
    show_in(number, load(file))
bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, len(files)
print(f"{len(files)} steps in frames 1 to {len(files)}")
