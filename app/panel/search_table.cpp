// The table of all that the search of commands can find.
#include "app/panel/search_table.h"

#include "app/config/config.h"
#include "app/config/first_placement.h"
#include "app/frame/history.h"
#include "app/panel/item_table.h"
#include "app/panel/parts/color_section.h"
#include "app/panel/parts/curve_drawer.h"
#include "app/panel/parts/piece_lines.h"
#include "app/panel/parts/sections.h"
#include "app/panel/parts/slice_lines.h"
#include "app/panel/parts/surfaces_section.h"
#include "app/panel/parts/time_track.h"
#include "app/text.h"
#include "index/export/surface_writer.h"
#include "index/measure/measures.h"
#include "interaction/controls/action_table.h"
#include "interaction/navigation/axis_views.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/story.h"
#include "interaction/step_track.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/slice_tool.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Chord;
using interaction::Coloring;
using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;
using interaction::Look;
using interaction::Modifier;
using interaction::WrittenPictures;

/// Other names of a control: words of ParaView, ChimeraX, napari, Blender, Fiji and of everyday use.
struct OtherNames {
    std::string_view control, names;
};
constexpr OtherNames kOtherNames[] = {
    // What the window does itself.
    {"open_data", "open file, load, load data, import data, recent files, recent data, other file, "
                  "dataset, folder, browse, reload, reopen, refresh, restore state, load state, "
                  "load session, previous session, drag and drop"},
    {"all_arrays", "list of arrays, variables, fields, scalars, channels, quantities"},
    {"help", "keyboard shortcuts, hotkeys, key bindings, user manual, documentation, guide, "
             "tutorial, tour, about, version, how to, preferences, settings, options"},
    {"full_screen", "fullscreen, maximize, presentation, kiosk, F11"},
    // Surfaces.
    {"isovalue",
     "threshold, level, contour, contour value, contour level, iso surface, isosurface, "
     "iso level, volume viewer level, cutoff, density level, surface value"},
    {"isovalue_up", "higher threshold, increase level"},
    {"isovalue_down", "lower threshold, decrease level"},
    {"usual_isovalue", "auto threshold, automatic threshold, otsu, default level, best isovalue, "
                       "good isovalue, guess threshold, reset isovalue"},
    {"add_surface",
     "add isosurface, second surface, second isosurface, another contour, two levels, "
     "multiple contours, nested surfaces, new surface, duplicate surface, more "
     "surfaces, several isovalues"},
    {"surface_of_array",
     "second array, overlay array, surface of another array, two variables, two "
     "arrays, second variable, second field, another quantity, combine arrays, "
     "compare variables, multivariate"},
    {"remove_surface", "delete surface, delete contour, remove isosurface"},
    {"hide_surface", "show surface, visibility, visible, eye, toggle surface, hide contour, "
                     "display surface"},
    {"opacity", "alpha, solid, opaque, density"},
    {"transparency",
     "transparent, translucent, see through, semitransparent, ghosted, x-ray, glass"},
    {"surface_color",
     "base color, solid color, diffuse color, paint, recolor, tint, rgb, uniform color, "
     "material color, color picker"},
    {"ghost_count",
     "ghost, onion skin, onion skinning, trail, trails, motion trail, earlier and later "
     "steps, other steps, several steps, two steps at once, two moments, compare steps, "
     "compare times, overlay time steps, before and after, afterimage, echo"},
    {"ghosts", "ghosts on, ghosts off, onion skin, onion skinning, trail, earlier and later steps"},
    {"earlier_ghosts",
     "earlier steps, previous surface, previous steps, past, where it was, history, "
     "trail behind"},
    {"later_ghosts", "later steps, next surface, future, where it goes, ahead"},
    {"ghost_spacing", "onion skin spacing, distance of ghosts, every how many steps, stride of the "
                      "trail"},
    {"ghost_opacity", "fade ghosts, onion skin opacity, strength of the trail"},
    {"remove_ghosts", "no ghosts, hide ghosts, onion skin off, no trail"},
    {"next_surface", "select surface, active surface, other surface"},
    {"dust",
     "remove small pieces, hide small disconnected pieces, specks, noise, islands, blobs, "
     "small blobs, minimum size, size filter, particles, despeckle, remove islands, debris"},
    {"pieces", "list of pieces, components, connected regions, label, labels, particle analysis, "
               "largest piece, biggest component, table of objects"},
    {"only_piece",
     "local view, isolate, extract piece, keep only, largest region, single component, show alone, "
     "extract connected region, solo"},
    {"hide_piece", "delete piece, remove piece, remove blob, erase component"},
    {"color_piece", "paint piece, highlight piece, color component, recolor region, label color"},
    {"all_pieces", "unhide pieces, bring back pieces, all components"},
    {"histogram", "distribution, statistics, value distribution, mean, average, percentiles, "
                  "threshold from histogram"},
    // Color.
    {"color_by", "color by array, coloring, map scalar onto surface, scalar coloring, texture, "
                 "color by value, color by variable, color by field, surface coloring, paint by"},
    {"color_by=surface", "solid color, single color, uniform color, no scalar coloring"},
    {"color_by=first_crossing", "arrival time, first arrival, activation time, isochrones, "
                                "isochron, when reached, time of arrival, front"},
    {"next_coloring", "color by, coloring"},
    {"next_color_array", "color by other array, color by next variable"},
    {"color_map", "colormap, lut, lookup table, palette, color table, color scheme, color ramp, "
                  "transfer function, color preset, colors, gradient"},
    {"color_map=turbo", "jet, rainbow, spectrum"},
    {"color_map=coolwarm", "cool to warm, diverging, blue to red, blue red, bipolar, red blue"},
    {"color_map=viridis", "colorblind, color blind safe, default colormap, perceptually uniform"},
    {"color_map=cividis", "colorblind, color blind safe, color vision deficiency"},
    {"color_map=inferno", "hot, fire, magma, plasma, black body, heat"},
    {"color_map=grayscale", "gray, black and white, monochrome, x ray"},
    {"color_map=gray", "gray, grays, black and white"},
    {"color_range", "range, scalar range, color limits, window level, contrast limits, contrast, "
                    "brightness and contrast, min max, minimum maximum, rescale to data range, "
                    "rescale over all timesteps, clim, custom range, clamp, scale colors, "
                    "autoscale, color levels"},
    {"color_range=all", "rescale to data range, full range, rescale over all timesteps, all times, "
                        "reset range, automatic range, fit range"},
    {"color_range=percentiles", "rescale to visible range, clip outliers, auto contrast, saturate, "
                                "robust range, quantiles"},
    {"color_range=by_hand", "custom range, set range, fixed range, window level, min max"},
    {"color_reversed", "invert lut, invert colormap, flip colors, inverse colors, reverse palette"},
    {"color_log", "log scale, logarithm, log10, logarithmic colors, linear scale"},
    {"color_bands", "discretize, discrete colors, number of colors, steps of color, table values, "
                    "contour bands, posterize"},
    // Look.
    {"background", "backdrop, background color, canvas, theme, world color, sky, bg, viewport "
                   "background, bgcolor"},
    {"background=light", "white background, light mode, light theme, bright background, paper, "
                         "for printing, white"},
    {"background=dark", "black background, dark mode, dark theme, night mode, black"},
    {"background=gradient", "gradient background, sky, two colors"},
    {"background=white", "pure white, paper, print, publication, #ffffff"},
    {"background=gray", "grey background, neutral background, too dark, brighter"},
    {"lift_background",
     "dark colors, dark surface, too dark, cannot see dark colors, black on black, "
     "brighter background, contrast, original background"},
    {"material", "shading, shininess, specular, highlights, reflection, gloss, roughness, surface "
                 "representation, smooth shading, flat shading, normals, phong, lighting model"},
    {"material=matte", "no specular, diffuse, dull, flat, rough"},
    {"material=glossy", "shiny, specular, highlights, soft"},
    {"material=metal", "metallic, mirror, reflection"},
    {"light", "lighting, lights, headlight, light direction, light source, key light, lamp, sun, "
              "illumination, brightness, too dark, move light, light kit"},
    {"light=usual", "reset light, default light, headlight"},
    {"occlusion", "ambient occlusion, ssao, ao, shadows, shadow, depth cue, crevices, cavity, "
                  "lighting soft, ambient shading, silhouette"},
    {"bounding_box", "box, outline, cube axes, axes, axes grid, data axes, axis labels, grid, "
                     "coordinates, frame, show bounds, extent, ticks, ruler axes, dimensions"},
    {"grid", "floor, ground, ground plane, horizon, floor grid"},
    {"orthographic", "orthogonal, ortho, parallel projection, perspective, camera projection, "
                     "isometric projection, projection, switch perspective ortho, numpad 5"},
    {"heights", "vertical exaggeration, z scale, stretch z, scale z, aspect ratio, anisotropic "
                "scale, relief, stretch"},
    {"exaggerate", "stretch z, taller"},
    {"flatten", "squash z, lower"},
    // Camera.
    {"view",
     "camera, viewpoint, view cube, standard views, front view, back view, left view, right "
     "view, top view, bottom view, side view, orientation axes, orientation, align view"},
    {"view=+x", "view along x, look along x, right view, yz plane"},
    {"view=-x", "look along minus x, left view, opposite x, yz plane"},
    {"view=+y", "view along y, look along y, back view, xz plane"},
    {"view=-y", "look along minus y, front view, opposite y, xz plane"},
    {"view=+z", "view along z, look along z, top view, plan view, from above, xy plane"},
    {"view=-z", "look along minus z, bottom view, from below, xy plane"},
    {"axis_view", "view along axis, front view, top view, side view, align to axis"},
    {"isometric_view", "isometric, corner view, 3d view, three quarter view, iso view"},
    {"reset",
     "reset view, reset camera, home, default view, fit, frame all, fit to window, view "
     "all, zoom to fit, zoom to data, initial view, reset to defaults, start over, restore "
     "defaults, reset everything, factory settings"},
    {"recenter", "center, center view, fit, frame all, frame selected, center of rotation, pivot, "
                 "orbit center, cofr, find data, look at, focus, zoom to data, bring back, lost"},
    {"zoom", "zoom in, zoom out, dolly, closer, nearer, magnify, scale, bigger, larger, smaller, "
             "enlarge, shrink, size"},
    {"turn", "rotate, rotation, orbit, spin, roll, azimuth, elevation, yaw, tilt, turntable, "
             "rotate view, swivel"},
    {"turn_left", "rotate left, spin left"},
    {"turn_right", "rotate right, spin right"},
    {"move", "pan, shift, translate, drag, move sideways, slide, move camera, move view"},
    {"fly", "fly through, flythrough, walkthrough, first person"},
    {"walk_forward", "walk, move camera, dolly"},
    {"teleport", "jump to place, walk"},
    {"save_view",
     "scene view, save camera, store view, bookmark view, camera bookmark, named view, add "
     "viewpoint, remember view, keyframe"},
    {"next_view", "camera bookmarks, saved views, restore view, recall view, go to viewpoint, "
                  "load camera"},
    // Stereo.
    {"stereo", "3d glasses, 3d display, stereoscopic, stereo mode, 3d tv, vr, virtual reality, "
               "headset, hmd, oculus, quest, side by side eyes, split screen, split view"},
    {"stereo=anaglyph", "red cyan, red blue glasses, 3d glasses, red green"},
    {"next_stereo", "stereo, 3d"},
    {"eyes", "eye separation, interocular distance, interpupillary distance, ipd, stereo depth, "
             "eye distance, parallax"},
    {"room_panel", "vr menu, vr panel, panel in the scene"},
    // Quality.
    {"quality", "performance, slow, speed up, laggy, level of detail, lod, render quality, "
                "resolution, antialiasing, anti-aliasing, smooth edges, jagged, full resolution, "
                "downsample, decimate, simplify, subsample, coarse, fine, detail, renderer, "
                "samples"},
    {"quality_auto", "automatic quality, default quality, adaptive"},
    {"quality_fast", "fast, low quality, performance, slow, faster, lag, downsample, coarse, "
                     "interactive, draft, preview, low resolution, decimate"},
    {"quality_best",
     "volume step 1, best quality, high quality, full resolution, exact, antialiasing, final, "
     "high resolution, fine, accurate"},
    {"quality_paper", "publication, reference, original method"},
    {"statistics", "frame rate, fps, frames per second, timing, memory, cache, cache size, ram, "
                   "number of triangles, number of cells, triangle count, polygons, performance "
                   "monitor, info, counts, gpu, benchmark, profile"},
    {"messages", "notifications, log, console, output, what was said, warnings, errors, saved "
                 "files, status, where is my file, open folder, copy path"},
    // Tools.
    {"pick_tool", "probe, pick value, pick point, select, inspect, hover, value at point, add "
                  "marker, add mark, add point, marker, landmark, point selection, query, seed, "
                  "pointer, identify, value under mouse, read value, cursor value"},
    {"probe", "probe, pixel value, value under mouse, value at cursor, inspect, read value, query, "
              "sample, voxel value, coordinates under mouse"},
    {"pick", "select, click, mark"},
    {"copy", "copy value, copy to clipboard, clipboard, copy coordinates, ctrl c"},
    {"slice_tool", "slice, slice plane, cross section, section, orthoslice, cut plane, plane, "
                   "values on a plane, image plane, multiplanar, mpr, contour plot, pseudocolor"},
    {"snap_slice", "slice, slice z, orthogonal slice, axial, sagittal, coronal, slice x y z"},
    {"add_slice", "second slice, several slices, three planes"},
    {"slice", "slice x, slice y, slice z, axial, sagittal, coronal, cross section"},
    {"slice_forward", "next slice, move slice, scroll slices"},
    {"slice_back", "previous slice, move slice, scroll slices"},
    {"slices_alone", "hide surfaces, only slice, show slice only, hide isosurface"},
    {"flat_slice", "2d view, 2d slice, flat view, face on, image view, plan view, look at slice"},
    {"remove_slices", "no slice, remove slice, delete slice, hide slice"},
    {"clip_tool", "clipping plane, cut plane, cross section, section, crop, cut, cutting plane, "
                  "cutaway, clip box, region of interest, roi, subvolume, "
                  "orthoslice, plane, split, knife, half, inside"},
    {"clip_box", "clip box, box, region of interest, roi, subvolume, crop, crop box, bounding box"},
    {"remove_box", "no box, remove crop, show whole"},
    {"snap_clip",
     "slice, slice z, axis aligned clip, cut along axis, crop, orthogonal slice, clip x "
     "y z, cross section"},
    {"flip_clip", "invert clip, other side, inside out, reverse clip, flip plane"},
    {"remove_clip", "no clip, clip off, unclip, remove slice, delete clip plane, show whole"},
    {"ruler_tool", "measure, measurement, distance, length, tape, line tool, dimension, caliper, "
                   "how far, how long, width, distance between points"},
    {"ruler_at_mark", "measure from the mark, distance from the mark, measure to the mark, begin ruler, "
                      "add place to ruler, distance between marks"},
    {"ruler_angle", "angle, protractor, measure angle, three points, degrees, corner, slope"},
    {"profile", "line profile, plot profile, plot over line, line plot, intensity profile, values "
                "along a line, transect, cross section curve, sample along line, linescan"},
    {"curves=profile", "line profile, plot over line, values along a line"},
    {"annotations",
     "viewport overlays, hide marks, hide rulers, hide annotations, show annotations, hide labels, "
     "declutter"},
    {"remove_rulers", "clear measurements, delete all measurements, remove all rulers"},
    {"remove_ruler", "clear measurements, delete measurement, remove distance, remove ruler, erase "
                     "measurement"},
    {"remove_mark", "delete markers, clear marks, remove marker, remove point, clear selection, "
                    "unselect, deselect, delete label, remove annotation"},
    {"remove_made", "clear measurements, delete marks, clear, erase, delete"},
    {"grab", "hold volume, move with hand"},
    // Time.
    {"step", "frame, timestep, time step, time index, go to frame, go to step, jump to frame, time "
             "stamp, frame number, time slider, scrub, seek"},
    {"time", "go to time, jump to time, t, current time, time stamp, timestamp, time label, seek, "
             "clock, moment, when"},
    {"step_forward", "next frame, next timestep, next time step, next, forward, advance"},
    {"step_back", "previous frame, previous timestep, previous time step, previous, prev, back, "
                  "backward"},
    {"first_step", "first frame, first timestep, first time step, beginning, start, rewind"},
    {"last_step", "last frame, last timestep, last time step, end, final frame, newest"},
    {"play", "pause, stop, animate, animation, start playback, run, resume, movie playback"},
    {"reverse", "play backwards, backward, rewind, reverse time, time reversal"},
    {"loop", "repeat, cycle, endless, play once, loop animation, loop playback"},
    {"ping_pong", "pingpong, bounce, boomerang, to and fro, forth and back, palindrome, swing"},
    {"speed", "playback speed, play speed, animation speed, slower, slowly, faster, time scale, "
              "slow motion, "
              "tempo, pace, duration"},
    {"rate", "fps, frames per second, steps per second, frame rate of playing, animation rate"},
    {"faster", "faster, speed up, playback speed, double speed"},
    {"slower", "slower, slowly, slow down, slow motion, playback speed, half speed"},
    {"speed_unit", "real time, sequence, snap to time steps, play mode, animation mode"},
    {"every", "stride, skip frames, every nth, time stride, subsample time, frame step"},
    {"between_steps",
     "interpolate, interpolation, blend, smooth playback, smooth animation, tween, "
     "temporal interpolation, morph, in between, slowly, gradually, stutter, jumps, jerky"},
    {"follow", "live, latest, newest step, in situ, auto update, watch, tail, monitor"},
    {"range_first", "start frame, trim start, time range, in point, loop start"},
    {"range_last", "end frame, trim end, time range, out point, loop end"},
    {"range_all", "whole series, reset time range, all frames, full time range"},
    {"curves", "query over time, curve, plot, graph, chart, diagram, time series, over time, plot "
               "over time, plot "
               "selection over time, measure, measurements, integrate variables, quantities, "
               "csv, spreadsheet, evolution, history, growth"},
    {"curves=area", "surface area, size of the surface, area over time, how large"},
    {"curves=volume", "volume over time, enclosed volume, how large, how big, size of the vortex, "
                      "amount"},
    {"curves=distance", "distance over time, distance to the surface, distance to the wall, how far, "
                        "how far from here, nearest distance, gap, clearance, how far in each step"},
    {"curves=pieces", "connected components, connectivity, count objects, number of objects, "
                      "number of pieces"},
    {"curves=euler", "genus, topology, holes, handles, euler characteristic"},
    {"save_time", "bookmark, time marker, favorite, mark time, remember time"},
    {"next_time", "next marker, bookmarks"},
    {"previous_time", "previous marker, bookmarks"},
    // Pictures, movies, files.
    {"screenshot",
     "save image, picture, photo, snapshot, save picture, png, capture, export image, "
     "render image, print, figure, transparent png, copy picture, save figure, still, "
     "save screenshot, tiff, jpeg"},
    {"picture_size", "resolution of pictures, dpi, figure 300 dpi, image size, image resolution, "
                     "width and height, supersample, print size, 4k, figure for a paper, pixels"},
    {"picture_background=white", "white background in pictures, for print, publication"},
    {"picture_background=transparent",
     "film transparent, transparent background, transparent picture, alpha channel, no background"},
    {"picture_scale", "magnification, scale factor, larger picture, times as large"},
    {"picture_dpi", "dots per inch, pixels per inch, ppi, 300 dpi, print resolution"},
    {"caption", "annotation, title of the picture, text annotation, time stamp, timestamp"},
    {"legend",
     "color bar, colorbar, scalar bar, color legend, color key, hide legend, color scale"},
    {"scale_bar",
     "center axes, scalebar, length bar, axes, orientation axes, axes triad, orientation marker, "
     "orientation widget, compass, micron bar"},
    {"box_in_pictures", "outline in pictures, axes in pictures"},
    {"marks_in_pictures", "annotations in pictures, labels in pictures"},
    {"movie", "save animation, export movie, export animation, make a movie, video, mp4, avi, gif, "
              "render animation, animation, film, keyframe, camera path, turntable movie"},
    {"movie_of_recording", "movie of camera path, keyframe, video of session, screen capture"},
    {"movie_of_turn", "turntable, rotate, spin, orbit, 360, rotation movie"},
    {"movie_of_both", "turntable, rotate and play, spin, orbit, time and turn, 4D movie"},
    {"movie_of_keys",
     "keyframes, key frames, camera path, animation, render animation, flythrough, "
     "film, video of keys"},
    {"movie_titled", "subtitles, captions in movie, text in movie, annotation, film with names"},
    {"movie_of_views",
     "camera path, along path, tour, flythrough, viewpoints movie, animate views"},
    {"figure_of_view", "publication figure, pdf, vector graphics, paper figure, export pdf, toml"},
    {"story_file", "presentation, slides, share story, export story, storyboard, guided tour"},
    {"next_told", "presentation, slide, next slide, slideshow, show story, present, narrate"},
    {"previous_told", "previous slide, slide back, presentation"},
    {"leave_story", "end presentation, stop slideshow, close card"},
    {"add_key", "keyframe, key frame, set key, insert keyframe, camera path, waypoint, animation, "
                "film, storyboard"},
    {"remove_key", "delete keyframe, delete key frame, clear key"},
    {"next_key", "next keyframe, camera path, preview keys"},
    {"previous_key", "previous keyframe, camera path"},
    {"movie_rate",
     "fps of movie, movie frame rate, video frame rate, frames per second of a movie"},
    {"record", "recording, record a movie, screen recording, trace, macro, log, capture session, "
               "keyframe, camera path, script"},
    {"stamp", "chapter, marker in recording, note"},
    {"export_surfaces", "export, save mesh, export mesh, save data, save surface, export geometry, "
                        "export scene, save as, write file, extract surface, 3d print, model"},
    {"export_surfaces=ply", "meshlab, polygon, export mesh as ply, save surface as ply"},
    {"export_surfaces=stl", "3d print, export stl, save mesh as stl, cad, printing"},
    {"export_surfaces=obj", "export obj, save mesh as obj, wavefront"},
    {"export_surfaces=vtp", "vtk, paraview, polydata, export vtk, pyvista"},
    {"export_surfaces=glb", "gltf, web, powerpoint, export gltf, sketchfab"},
    {"export_surfaces=glb-animation", "animated gltf, export animation for the web"},
    {"export_surfaces=usda", "usd, blender, omniverse, export usd, alembic, universal scene"},
    {"export_surfaces=csv", "table, spreadsheet, excel, save numbers, export table, text, values, "
                            "pandas, points"},
    {"save_session", "save state, save project, save workspace, save session, save, store session"},
    // Data and window.
    {"data",
     "min max query, missing files, missing steps, information, info, properties, metadata, "
     "dimensions, units, unit, voxel size, spacing, "
     "extent, bounds, size, value range, shape, number of points, statistics, memory size, "
     "pixel size, data type, details, header, minimum, maximum, missing values, nan, holes, gaps, "
     "fill value"},
    {"objects", "outliner, pipeline browser, object list, list of objects, layers, layer list, "
                "scene tree, tree view, scene graph, what is in the picture, visibility, hide, "
                "list of marks, list of slices, list of rulers, show and hide"},
    {"array", "variable, scalar, scalars, active scalars, field, channel, quantity, component, "
              "contour by, layer, attribute, dataset"},
    {"next_array", "next variable, switch variable, other field, next layer"},
    {"open_model", "open mesh, load mesh, import mesh, stl, ply, obj, vtp, gltf, glb, geometry, "
                   "coastline, bone, segmentation, cad, triangles, "
                   "polygons, model"},
    {"model", "hide mesh, show mesh, hide model, show model, hull, context"},
    {"model_edges", "wireframe, mesh lines, edges of a model, surface with edges"},
    {"model_opacity", "transparent hull, transparent mesh, see through model"},
    {"remove_models", "close mesh, no model, delete model, remove mesh"},
    {"undo", "take back, revert, go back, undo camera, previous view"},
    {"redo", "do again, repeat change, restore change"},
    {"panel", "sidebar, side panel, hide sidebar, hide panel, toolbar, properties, dock, ui, hide "
              "interface, menu, distraction free, inspector"},
    {"quit", "exit, close, close program, leave"},
    {"ask_to_quit", "exit, close, close program, quit program, leave"},
};

std::string_view other_names(std::string_view control) {
    const auto* const row = std::ranges::find(kOtherNames, control, &OtherNames::control);
    return row == std::end(kOtherNames) ? std::string_view() : row->names;
}

std::vector<KeyCommand> all_key_commands() {
    std::vector<KeyCommand> all{
        {"open other data", "Ctrl + O", Key{'O'}, Chord::control, {}, "open_data", false},
        {"arrays: choose by name, values, unit and grid",
         "Ctrl + Shift + A",
         Key{'A'},
         Chord::control_shift,
         {},
         "all_arrays"},
        {"help: keys, mouse and devices", "F1", Key::f1, Chord::none, {}, "help", false},
        {"full screen on, off", "F11", Key::f11, Chord::none, {}, "full_screen", false}};
    for (const interaction::KeyLine& line : interaction::key_lines())
        for (const interaction::ActionRow& row : line.actions)
            if (!row.keys.empty() && !(row.traits & interaction::kHeld))
                all.push_back({row.words.empty() ? line.effect : row.words, name_of(row.keys[0]),
                               row.keys[0].key, row.keys[0].chord, row.action});
    return all;
}

/// The sections, in the order of `sections()`.
enum SectionNumber : std::size_t { kData, kObjects, kSurfaces, kColor, kView, kTimeBar };
static_assert(std::size_t{kTimeBar} == kSections);

std::string percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

/// A share as people type it: `40`, or `0.4` for 40 percent.
double share_of(double typed) {
    return std::clamp(typed > 0 && typed <= 1 ? typed : typed / 100, 0.0, 1.0);
}

/// Lines as they are added.
class Lines {
  public:
    explicit Lines(const PanelModel& model) : model_(model) {}

    SearchLine& add(SearchLine line) {
        if (line.others.empty())
            line.others = other_names(line.name);
        lines_.push_back(std::move(line));
        return lines_.back();
    }
    /// A control that a section has.
    SearchLine& control(std::string name, std::string words, std::string value,
                        std::size_t section) {
        return add({.name = std::move(name),
                    .words = std::move(words),
                    .value = std::move(value),
                    .section = section});
    }
    /// Commands that set something; the line says where it is so already.
    template <class T>
    void value(std::string name, std::string words,
               std::optional<T> interaction::SettingChanges::* member,
               const std::type_identity_t<T>& wanted, const std::type_identity_t<T>& now) {
        SearchLine& line = add({.name = std::move(name),
                                .words = std::move(words),
                                .value = wanted == now ? "now" : ""});
        line.commands.*member = wanted;
    }
    /// A line that turns something on, or off.
    void on_or_off(std::string name, std::string words, bool on, const Commands& commands) {
        add({.name = std::move(name),
             .words = std::move(words),
             .value = on ? "on" : "off",
             .commands = commands});
    }
    std::vector<SearchLine> take() { return std::move(lines_); }
    const PanelModel& model() const { return model_; }

  private:
    const PanelModel& model_;
    std::vector<SearchLine> lines_;
};

/// The way out of an empty picture.
void add_way_out(Lines& lines) {
    const auto& empty = lines.model().notes.empty;
    if (empty && !empty->way.empty())
        lines.add({.name = "way_out",
                   .words = empty->sentence + " " + empty->way,
                   .others =
                       "way out, nothing shown, no surface, empty picture, blank, black, where "
                       "is my data, data gone, lost, invisible, why is it empty",
                   .key = "Enter",
                   .commands = empty->commands});
}

/// What undo or redo would change.
std::string way_words(const PanelModel& model, std::optional<interaction::Action> action) {
    const bool undo = action == interaction::Action::undo;
    if (!undo && action != interaction::Action::redo)
        return "";
    return words_for_way(model.asked, undo ? model.ways.undo : model.ways.redo, model.info.steps());
}

void add_keys(Lines& lines) {
    for (const KeyCommand& each : key_commands())
        lines.add({.name = std::string(each.action ? name_of(*each.action) : each.found_as),
                   .words = each.words,
                   .value = way_words(lines.model(), each.action),
                   .key = each.name,
                   .press = &each,
                   .in_room = each.in_room});
    for (const interaction::KeyLine& line : interaction::key_lines())
        for (const interaction::ActionRow& row : line.actions)
            if (!row.keys.empty() && (row.traits & interaction::kHeld))
                lines.add({.name = row.name,
                           .words = line.effect,
                           .key = name_of(row.keys[0]) + " (hold)",
                           .page = SearchPage::help,
                           .in_room = false});
}

/// Commands that change the picked surface.
template <class Change>
Commands with_picked(const PanelModel& model, const Change& change) {
    Commands commands;
    commands.isosurfaces = model.asked.isosurfaces;
    change((*commands.isosurfaces)[model.asked.picked]);
    return commands;
}

void add_surfaces(Lines& lines) {
    const PanelModel& model = lines.model();
    const auto& surfaces = model.asked.isosurfaces;
    const auto said = [&info = model.picked_info()](double value) {
        return with_unit(value, info.value_unit, info.digits);
    };
    const index::IndexStats& stats = model.picked_stats();
    const auto with_opacity = [&model](double opacity) {
        return with_picked(model, [opacity](interaction::Isosurface& surface) {
            surface.opacity = static_cast<float>(opacity);
        });
    };
    lines.control("isovalue", "isovalue", said(model.asked.isovalue()), kSurfaces).with_number =
        [said](double number) {
            NumberEffect effect{said(number), {}};
            effect.commands.isovalue = number;
            return effect;
        };
    if (stats.low < stats.high && !stats.histogram.empty()) {
        const double usual = quantile(stats, kFirstQuantile);
        SearchLine& line = lines.add({.name = "usual_isovalue",
                                      .words = "isovalue: the usual one of these values",
                                      .value = said(usual)});
        line.commands.isovalue = usual;
    }
    const double opacity = surfaces[model.asked.picked].opacity;
    lines.control("opacity", "opacity of the surface", percent(opacity), kSurfaces).with_number =
        [with_opacity](double number) {
            return NumberEffect{percent(share_of(number)), with_opacity(share_of(number))};
        };
    SearchLine& through = lines.add({.name = "opacity",
                                     .words = "transparency of the surface",
                                     .others = std::string(other_names("transparency")),
                                     .value = percent(1 - opacity),
                                     .commands = with_opacity(opacity < 1 ? 1.0 : kSeenThrough)});
    through.with_number = [with_opacity](double number) {
        return NumberEffect{percent(share_of(number)), with_opacity(1 - share_of(number))};
    };
    lines.add({.name = "hide_surface",
               .words = opacity > 0 ? "hide the surface" : "show the surface",
               .commands = with_opacity(opacity > 0 ? 0.0 : 1.0)});
    lines.control("surface_color", "color of the surface", "", kSurfaces);
    if (surfaces.size() < interaction::kMostIsosurfaces)
        lines.add({.name = "add_surface",
                   .words = "add another surface",
                   .value = fmt::format("{} shown", surfaces.size()),
                   .commands = with_another(model)});
    for (std::size_t i = 0; i < model.arrays.names.size(); ++i)
        if (i != model.arrays.asked && surfaces.size() < interaction::kMostIsosurfaces)
            lines.add({.name = "surface_of_array=" + model.arrays.names[i],
                       .words = "add a surface of another array: " + model.arrays.names[i],
                       .others = std::string(other_names("surface_of_array")),
                       .commands = with_surface_of(model, i)});
    if (surfaces.size() > 1)
        lines.add({.name = "remove_surface",
                   .words = "remove the surface",
                   .commands = without_surface(model, model.asked.picked)});
    lines
        .control("dust", "dust: hide pieces of fewer cells",
                 model.asked.pieces.dust == 0
                     ? "none"
                     : fmt::format("fewer than {} cells", model.asked.pieces.dust),
                 kSurfaces)
        .with_number = [&model](double number) {
        NumberEffect effect{{}, with_dust(model.asked, number)};
        const std::uint32_t dust = effect.commands.pieces->dust;
        effect.words = dust == 0 ? "none" : fmt::format("fewer than {} cells", dust);
        return effect;
    };
    lines.control("pieces", "pieces of the surface: list", words_for_pieces(model), kSurfaces);
    if (const auto piece = piece_at_mark(model.asked)) {
        lines.add({.name = "only_piece",
                   .words = "show only the piece at the mark",
                   .commands = only_piece(model.asked, *piece)});
        if (const auto hidden = hidden_piece(model.asked, *piece))
            lines.add(
                {.name = "hide_piece", .words = "hide the piece at the mark", .commands = *hidden});
        if (const auto colored = colored_piece(model.asked, *piece))
            lines.add({.name = "color_piece",
                       .words = "give the piece at the mark a color of its own",
                       .commands = *colored});
    }
    if (!model.asked.pieces.all())
        lines
            .add({.name = "all_pieces",
                  .words = "show all pieces of the surfaces",
                  .value = words_for_pieces(model)})
            .commands.pieces = interaction::ShownPieces{};
    lines.control("histogram", "histogram of the values",
                  range_text(stats.low, stats.high, model.picked_info().value_unit), kSurfaces);
}

void add_ghosts(Lines& lines) {
    const PanelModel& model = lines.model();
    const interaction::Ghosts& now = model.asked.ghosts;
    if (model.info.steps() < 2)
        return;
    using interaction::Ghosts;
    const auto number = [&](const char* name, const char* words, std::string value,
                            const auto& change) {
        lines.control(name, words, std::move(value), kSurfaces).with_number =
            [now, change](double typed) {
                Ghosts changed = now;
                NumberEffect effect{change(changed, typed), {}};
                effect.commands.ghosts = changed;
                return effect;
            };
    };
    const auto count = [](double typed) {
        return static_cast<std::uint32_t>(
            std::clamp(std::round(typed), 0.0, double{interaction::kMostGhosts}));
    };
    const auto in_words = [](const Ghosts& ghosts) {
        return fmt::format("{} earlier, {} later", ghosts.earlier, ghosts.later);
    };
    const auto every_words = [](std::uint32_t every) {
        return every == 1 ? "each step" : fmt::format("every {} steps", every);
    };
    number("ghost_count", "ghosts: how many earlier and later steps", in_words(now),
           [=](Ghosts& ghosts, double typed) {
               ghosts.earlier = ghosts.later = count(typed);
               return in_words(ghosts);
           });
    number("earlier_ghosts", "ghosts: earlier steps", fmt::format("{}", now.earlier),
           [=](Ghosts& ghosts, double typed) {
               ghosts.earlier = count(typed);
               return in_words(ghosts);
           });
    number("later_ghosts", "ghosts: later steps", fmt::format("{}", now.later),
           [=](Ghosts& ghosts, double typed) {
               ghosts.later = count(typed);
               return in_words(ghosts);
           });
    number("ghost_spacing", "ghosts: steps from one to the next", every_words(now.every),
           [=](Ghosts& ghosts, double typed) {
               ghosts.every = static_cast<std::uint32_t>(
                   std::clamp(std::round(typed), 1.0, double{interaction::kWidestGhosts}));
               return every_words(ghosts.every);
           });
    number("ghost_opacity", "ghosts: opacity", percent(double{now.opacity}),
           [=](Ghosts& ghosts, double typed) {
               ghosts.opacity = static_cast<float>(share_of(typed));
               return percent(share_of(typed));
           });
    if (now.earlier + now.later > 0) {
        Ghosts none = now;
        none.earlier = none.later = 0;
        lines.add({.name = "remove_ghosts", .words = "remove the ghosts"}).commands.ghosts = none;
    }
}

void add_coloring(Lines& lines) {
    const PanelModel& model = lines.model();
    const Coloring& now = model.asked.coloring;
    const auto add = [&](std::string name, std::string words, const auto& change) {
        Coloring changed = now;
        change(changed);
        lines.value(std::move(name), std::move(words), &Commands::coloring, changed, now);
    };
    const auto by = [&](interaction::ColorBy what, const std::string& array) {
        return [&now, what, array](Coloring& changed) {
            if (now.by != what || now.array != array)
                changed.range.reset();
            changed.by = what;
            changed.array = array;
        };
    };
    const bool has_values = now.by == interaction::ColorBy::value;
    const std::string array = has_values && model.arrays.color < model.arrays.color_names.size()
                                  ? model.arrays.color_names[model.arrays.color]
                                  : std::string(name_of(now.by));
    lines.control("color_by", "color by", array, kColor);
    add("color_by=surface", "color by: surface", by(interaction::ColorBy::surface, now.array));
    for (std::size_t i = 0; i < model.arrays.color_names.size(); ++i)
        if (const std::string& each = model.arrays.color_names[i];
            !has_values || i != model.arrays.color)
            add("color_by=" + each, "color by: array " + each,
                by(interaction::ColorBy::value, each));
    add("color_by=first_crossing", "color by: first crossing",
        by(interaction::ColorBy::first_crossing, now.array));
    lines.control("color_map", "color map", now.map, kColor);
    for (const OfferedMap& map : offered_maps(model))
        add("color_map=" + map.name, "color map: " + map.words, [&](Coloring& changed) {
            changed.map = map.name;
            changed.colors = map.colors;
        });
    const std::array<double, 2>& range = model.colors.range;
    lines.control("color_range", "range of the colors",
                  now.range         ? range_text((*now.range)[0], (*now.range)[1])
                  : now.percentiles ? "percentiles"
                                    : "of all values",
                  kColor);
    add("color_range=all", "range of the colors: of all values of all steps",
        [](Coloring& changed) {
            changed.range.reset();
            changed.percentiles.reset();
        });
    add("color_range=percentiles", "range of the colors: percentiles 2 to 98",
        [](Coloring& changed) {
            changed.range.reset();
            changed.percentiles = {2.0, 98.0};
        });
    if (range[0] < range[1] && !now.range)
        add("color_range=by_hand", "range of the colors: set by hand", [&range](Coloring& changed) {
            changed.percentiles.reset();
            changed.range = range;
        });
    add("color_reversed", "color map: the other way around (reversed)",
        [](Coloring& changed) { changed.reversed = !changed.reversed; });
    add("color_log", now.logarithmic ? "colors: linear scale" : "colors: logarithmic scale",
        [](Coloring& changed) { changed.logarithmic = !changed.logarithmic; });
    lines
        .control("color_bands", "bands of the color map",
                 now.bands == 0 ? "none" : std::to_string(now.bands), kColor)
        .with_number = [&now](double number) {
        Coloring changed = now;
        changed.bands = static_cast<std::uint32_t>(
            std::clamp(std::round(number), 0.0, double{interaction::kMostBands}));
        NumberEffect effect{std::to_string(changed.bands), {}};
        effect.commands.coloring = changed;
        return effect;
    };
}

void add_look(Lines& lines) {
    const Look& now = lines.model().asked.look;
    const auto add = [&](std::string name, std::string words, const auto& change) {
        Look changed = now;
        change(changed);
        lines.value(std::move(name), std::move(words), &Commands::look, changed, now);
    };
    const auto add_each = [&](const char* setting, auto Look::* member) {
        using Value = std::decay_t<decltype(now.*member)>;
        lines.control(setting, setting, std::string(name_of(now.*member)), kView);
        const std::vector<std::string> names = interaction::all_names<Value>();
        for (std::size_t i = 0; i < names.size(); ++i)
            add(fmt::format("{}={}", setting, names[i]), fmt::format("{}: {}", setting, names[i]),
                [&](Look& changed) { changed.*member = static_cast<Value>(i); });
    };
    add_each("background", &Look::background);
    add_each("material", &Look::material);
    lines.control("light", "light: where it comes from", now.light ? "turned" : "usual", kView);
    add("light=usual", "light: from where it usually comes",
        [](Look& changed) { changed.light.reset(); });
    lines.control("occlusion", "ambient occlusion", percent(double{now.occlusion}), kView)
        .with_number = [&now](double number) {
        Look changed = now;
        changed.occlusion = static_cast<float>(share_of(number));
        NumberEffect effect{percent(share_of(number)), {}};
        effect.commands.look = changed;
        return effect;
    };
    add("occlusion=none", "ambient occlusion: none",
        [](Look& changed) { changed.occlusion = 0.0f; });
    add("occlusion=usual", "ambient occlusion: as usual",
        [](Look& changed) { changed.occlusion = Look{}.occlusion; });
}

void add_view(Lines& lines) {
    const PanelModel& model = lines.model();
    const interaction::Similarity& now = model.asked.room_from_physical;
    const glm::dvec3 center = physical_center(model.info.grid);
    const glm::dvec3 in_room = transform(now, center);
    const auto placed = [](const interaction::Similarity& place) {
        Commands commands;
        commands.room_from_physical = place;
        return commands;
    };
    lines.control("quality", "quality", std::string(name_of(model.asked.quality)), kView);
    lines.control("view", "view: saved viewpoints, box, projection", "", kView);
    for (std::size_t i = 0; i < interaction::kIsometric; ++i) {
        const interaction::AxisView& view = interaction::axis_views()[i];
        lines.add({.name = fmt::format("view={}", view.name),
                   .words = fmt::format("look from {}", view.name),
                   .commands = placed(seen_from(view, now, center, model.head))});
    }
    const auto zoomed = [=](double factor) {
        return placed(scaled(now, in_room, factor, std::numeric_limits<double>::min(),
                             std::numeric_limits<double>::max()));
    };
    constexpr double kZoom = 1.25, kTurn = 30.0;
    lines.add({.name = "zoom", .words = "enlarge the data (wheel)", .commands = zoomed(kZoom)})
        .with_number = [zoomed](double number) {
        const double factor = number > 0 ? std::clamp(number, 0.01, 100.0) : 1.0;
        return NumberEffect{fmt::format("x {:.4g}", factor), zoomed(factor)};
    };
    const auto rotated = [=](double degrees) {
        return placed(turned(now, in_room, {0, 1, 0}, degrees * std::numbers::pi / 180));
    };
    lines.add({.name = "turn", .words = "turn the data (drag)", .commands = rotated(kTurn)})
        .with_number = [rotated](double number) {
        const double degrees = std::remainder(number, 360.0);
        return NumberEffect{fmt::format("{:.4g}\u00b0", degrees), rotated(degrees)};
    };
    lines.add({.name = "move",
               .words = "move the data (drag with Shift)",
               .page = SearchPage::help,
               .in_room = false});
    lines
        .control("heights", "heights (z), exaggerated", fmt::format("x {:.3g}", now.exaggeration),
                 kView)
        .with_number = [=](double number) {
        const double factor = number > 0 ? std::clamp(number, 0.1, 100.0) : 1.0;
        return NumberEffect{fmt::format("x {:.4g}", factor),
                            placed(exaggerated(now, center, factor))};
    };
    for (const interaction::Viewpoint& each : model.asked.views)
        lines.value("viewpoint=" + each.name, "viewpoint: " + each.name,
                    &Commands::room_from_physical, each.room_from_physical, now);
    lines.control("stereo", "stereo", model.asked.stereo, kView);
    for (const std::string& name : offered_stereo(model))
        lines.value("stereo=" + name, "stereo: " + name, &Commands::stereo, name,
                    model.asked.stereo);
    lines
        .control("eyes", "distance between the eyes",
                 fmt::format("{:.0f} mm", 1000.0 * double{model.asked.eye_separation}), kView)
        .with_number = [](double number) {
        NumberEffect effect;
        const double widest = 1000.0 * double{interaction::kWidestEyes};
        effect.commands.eye_separation =
            static_cast<float>(std::clamp(number, 0.0, widest) / 1000.0);
        effect.words = fmt::format("{:.0f} mm", std::clamp(number, 0.0, widest));
        return effect;
    };
    lines.add({.name = "messages",
               .words = "messages: what was said, and when",
               .page = SearchPage::messages,
               .in_room = false});
    if (model.room_from_outside)
        lines.add({.name = "about_room",
                   .words = "the emulated room: what the window shows",
                   .others = "cave, emulation, outside, walls, introduction, card",
                   .page = SearchPage::room,
                   .in_room = false});
    if (model.place == PanelPlace::over)
        lines.add({.name = "statistics",
                   .words = "figures of drawing and memory",
                   .page = SearchPage::statistics,
                   .in_room = false});
}

void add_tools(Lines& lines) {
    const ExplorerState& asked = lines.model().asked;
    const auto remove = [&](const char* name, const char* words, bool there, auto member,
                            const auto& nothing) {
        if (there)
            lines.add({.name = name, .words = words}).commands.*member = nothing;
    };
    remove("remove_mark", "remove the mark", asked.mark.point.has_value(), &Commands::mark,
           interaction::Mark{});
    const interaction::Rulers& rulers = asked.rulers;
    remove("remove_ruler", "remove the ruler", rulers.chosen() != nullptr, &Commands::rulers,
           without_ruler(rulers, rulers.picked));
    if (asked.mark.point)
        if (interaction::Rulers longer = with_place(rulers, asked.mark.point->position);
            longer != rulers)
            lines.add({.name = "ruler_at_mark", .words = "ruler: its next place is the mark"})
                .commands.rulers = std::move(longer);
    remove("remove_rulers", "remove all rulers", rulers.list.size() > 1, &Commands::rulers,
           interaction::Rulers{.angle = rulers.angle});
    remove("remove_clip", "remove the clip plane", asked.clip.shown, &Commands::clip,
           interaction::ClipPlane{});
    if (asked.clip_box.shown)
        remove("remove_box", "remove the clip box", true, &Commands::clip_box,
               interaction::ClipBox{});
    else
        lines.value("clip_box", "clip box around the data", &Commands::clip_box,
                    interaction::whole_box(lines.model().data), asked.clip_box);
    remove("remove_slices", "remove the slices", asked.slices.shown(), &Commands::slices,
           interaction::Slices{});
    const interaction::Slices& slices = asked.slices;
    if (slices.shown())
        lines.add({.name = "flat_slice",
                   .words = "flat: look straight at the slice",
                   .commands = flat_view(lines.model(), slices)});
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        const char* const name = kAxes[static_cast<std::size_t>(axis)];
        const interaction::Slices across = snapped(slices, axis, lines.model().data);
        Commands commands;
        commands.slices = across;
        lines
            .add({.name = fmt::format("slice={}", name),
                  .words = fmt::format("slice across {}", name),
                  .commands = commands})
            .with_number = [across, &unit = lines.model().info.length_unit](double number) {
            interaction::Slices there = across;
            interaction::Plane& plane = there.planes[there.picked];
            plane.point += (number - glm::dot(plane.point, plane.normal)) * plane.normal;
            NumberEffect effect{with_unit(number, unit), {}};
            effect.commands.slices = there;
            return effect;
        };
    }
}

/// What stands in the picture, each by its name: choosing its line is its eye.
void add_objects(Lines& lines) {
    const PanelModel& model = lines.model();
    lines.control("objects", "objects: the list of what is in the picture", words_for_items(model),
                  kObjects);
    for (const ItemKind& kind : item_kinds())
        for (std::size_t i = 0; i < kind.count(model); ++i) {
            const Item item = kind.item(model, i);
            if (kind.places && !kind.places(model, i).empty()) {
                Commands way;
                way.room_from_physical = model.asked.room_from_physical;
                go_to_item(kind, model, i, way);
                lines.add({.name = fmt::format("see_{}={}", kind.name, item.name),
                           .words = "go to " + words_of_item(item),
                           .others = "bring into view, focus, find, look at, jump to",
                           .commands = std::move(way)});
            }
            if (!kind.has_eye())
                continue;
            SearchLine& line = lines.add(
                {.name = fmt::format("{}={}", kind.name, item.name),
                 .words = fmt::format("{} {}", item.shown ? "hide" : "show", words_of_item(item)),
                 .others = std::string(other_names(kind.name)),
                 .value = item.shown ? "shown" : "hidden"});
            if (!item.faulty) // else its eye may open a file
                show_item(kind, model, i, !item.shown, line.commands);
        }
}

/// The models, each by the name of its file.
void add_models(Lines& lines) {
    const std::vector<KeyCommand>& keys = key_commands();
    const auto opens =
        std::ranges::find(keys, std::string_view("open_data"), &KeyCommand::found_as);
    if (opens != keys.end())
        lines.add({.name = "open_model",
                   .words = "open a model: a file of triangles beside the surfaces",
                   .key = opens->name,
                   .press = &*opens,
                   .in_room = opens->in_room});
    const std::vector<interaction::Model>& models = lines.model().asked.models;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::string name = std::filesystem::path(models[i].path).filename().string();
        const auto with = [&models, i](const auto& change) {
            Commands commands;
            commands.models = models;
            change((*commands.models)[i]);
            return commands;
        };
        const auto add = [&](const char* control, std::string words,
                             bool interaction::Model::* on) {
            lines.add(
                {.name = fmt::format("{}={}", control, name),
                 .words = std::move(words),
                 .others = std::string(other_names(control)),
                 .value = models[i].*on ? "on" : "off",
                 .commands = with([on](interaction::Model& each) { each.*on = !(each.*on); })});
        };
        add("model_edges", fmt::format("model {}: edges, not faces", name),
            &interaction::Model::lines);
        const auto opaque = [with](double opacity) {
            return with([opacity](interaction::Model& each) {
                each.opacity = static_cast<float>(opacity);
            });
        };
        const double opacity = models[i].opacity;
        lines
            .add({.name = fmt::format("model_opacity={}", name),
                  .words = fmt::format("model {}: opacity", name),
                  .others = std::string(other_names("model_opacity")),
                  .value = percent(opacity),
                  .commands = opaque(opacity < 1 ? 1.0 : kSeenThrough)})
            .with_number = [opaque](double number) {
            return NumberEffect{percent(share_of(number)), opaque(share_of(number))};
        };
    }
    if (!models.empty())
        lines.add({.name = "remove_models", .words = "remove the models"}).commands.models =
            std::vector<interaction::Model>();
}

/// The drawer of curves, opened with a measure.
void add_curves(Lines& lines) {
    const ExplorerState& asked = lines.model().asked;
    const auto add = [&](std::string_view measure, const std::string& words) {
        interaction::CurveDrawer wanted = asked.curves;
        wanted.shown = true;
        wanted.measure = measure;
        lines.value(fmt::format("curves={}", measure), words, &Commands::curves, wanted,
                    asked.curves);
    };
    for (const index::Measure& each : index::measures())
        if (is_measured(each, asked.coloring.by == interaction::ColorBy::value,
                        asked.mark.point.has_value()))
            add(each.name, fmt::format("curve: {} over time", words_of_measure(each.name)));
    if (asked.mark.point)
        add(kMarkCurve, "curve: value at the mark over time");
    if (asked.rulers.chosen() && asked.rulers.chosen()->complete())
        add(kProfileCurve, "curve: values along the ruler");
}

Commands shown_at(const PanelModel& model, index::Instant at) {
    Commands commands;
    show(at, commands);
    commands.playback = model.asked.playback;
    commands.playback->playing = false;
    return commands;
}

/// The instant at a time of the data; the nearest end for a time outside.
index::Instant instant_at(const PanelModel& model, double time) {
    const interaction::StepTimes known = known_times(model.info, model.asked.steps);
    const std::uint32_t last = last_step(model);
    if (time <= known.at.front() || last == 0)
        return index::Instant(0);
    if (time >= known.at.back())
        return index::Instant(last);
    const interaction::StepTrack track(known.at, {}, {});
    const double after = time - known.at.front();
    return model.asked.blends() ? track.instant_at(after, known.gaps)
                                : index::Instant(track.step(track.place_at(after)));
}

void add_time(Lines& lines) {
    const PanelModel& model = lines.model();
    const std::uint32_t last = last_step(model);
    const index::Instant at = model.asked.shown_instant();
    lines.control("step", "step", fmt::format("{} of {}", at.step + 1, last + 1), kTimeBar)
        .with_number = [&model, last](double number) {
        const double step = std::clamp(std::round(number), 1.0, static_cast<double>(last) + 1);
        return NumberEffect{fmt::format("{:.0f} of {}", step, last + 1),
                            shown_at(model, index::Instant(static_cast<std::uint32_t>(step - 1)))};
    };
    if (!model.info.times.empty())
        lines.control("time", "time", time_of(model, at), kTimeBar).with_number =
            [&model](double number) {
                const index::Instant to = instant_at(model, number);
                return NumberEffect{time_of(model, to), shown_at(model, to)};
            };
    const interaction::PlaybackState& playback = model.asked.playback;
    const auto played = [&](const char* name, const char* words, std::string value,
                            const auto& change) {
        lines.control(name, words, std::move(value), kTimeBar).with_number =
            [&playback, change](double number) {
                interaction::PlaybackState changed = playback;
                NumberEffect effect{change(changed, number), {}};
                effect.commands.playback = changed;
                return effect;
            };
    };
    using interaction::SpeedUnit;
    const auto speed_words = [](double speed) { return fmt::format("x {:.3g}", speed); };
    const auto rate_words = [](double rate) { return fmt::format("{:.3g} steps a second", rate); };
    played("speed", "speed: the whole series in 10 s at x 1",
           playback.unit == SpeedUnit::series ? speed_words(playback.speed) : "",
           [=](interaction::PlaybackState& state, double number) {
               state.unit = SpeedUnit::series;
               state.speed = std::clamp(number, interaction::kSlowest, interaction::kFastest);
               return speed_words(state.speed);
           });
    played("rate", "speed: steps a second",
           playback.unit == SpeedUnit::steps ? rate_words(playback.rate) : "",
           [=](interaction::PlaybackState& state, double number) {
               state.unit = SpeedUnit::steps;
               state.rate = std::clamp(number, 0.001, 1000.0);
               return rate_words(state.rate);
           });
    const auto every_words = [](std::uint32_t every) {
        return every == 1 ? "every step" : fmt::format("1 step in {}", every);
    };
    played("every", "play only some of the steps", every_words(playback.every),
           [=](interaction::PlaybackState& state, double number) {
               state.every = static_cast<std::uint32_t>(
                   std::clamp(std::round(number), 1.0, double{interaction::kMostSkipped}));
               return every_words(state.every);
           });
    for (const interaction::Bookmark& each : model.asked.bookmarks)
        lines.add({.name = "bookmark=" + each.name,
                   .words = "bookmark: " + each.name,
                   .commands = shown_at(model, each.instant)});
}

void add_pictures(Lines& lines) {
    const PanelModel& model = lines.model();
    const WrittenPictures& now = model.asked.pictures;
    const auto changed = [&now](const auto& change) {
        Commands commands;
        commands.pictures = now;
        change(*commands.pictures);
        return commands;
    };
    const auto part = [&](const char* name, const char* words, bool WrittenPictures::* member) {
        lines.on_or_off(name, words, now.*member, changed([member](WrittenPictures& pictures) {
                            pictures.*member = !(pictures.*member);
                        }));
    };
    part("legend", "legend of the colors", &WrittenPictures::legend);
    part("scale_bar", "scale bar and axes", &WrittenPictures::scale_bar);
    part("box_in_pictures", "box in pictures that are saved", &WrittenPictures::box);
    part("marks_in_pictures", "mark, ruler and clip plane in pictures that are saved",
         &WrittenPictures::marks);
    part("caption", "caption in pictures that are saved", &WrittenPictures::caption);
    for (const std::string_view name : interaction::kNames<interaction::WrittenBackground>) {
        const auto background = *interaction::value_named<interaction::WrittenBackground>(name);
        lines.add(
            {.name = fmt::format("picture_background={}", name),
             .words = fmt::format(
                 "background of pictures that are saved: {}",
                 background == interaction::WrittenBackground::shown ? "as set in View" : name),
             .value = now.background == background ? "on" : "",
             .commands =
                 changed([=](WrittenPictures& pictures) { pictures.background = background; })});
    }
    const auto number_of = [&](const char* name, const char* words,
                               double WrittenPictures::* member, double low, double high) {
        lines
            .add({.name = name,
                  .words = words,
                  .value = fmt::format("{:.4g}", now.*member),
                  .commands = changed([=](WrittenPictures& pictures) {
                      pictures.*member = WrittenPictures{}.*member;
                  })})
            .with_number = [=](double number) {
            const double value = std::clamp(number, low, high);
            return NumberEffect{
                fmt::format("{:.4g}", value),
                changed([=](WrittenPictures& pictures) { pictures.*member = value; })};
        };
    };
    number_of("picture_scale", "scale of pictures that are saved", &WrittenPictures::scale, 1,
              interaction::kLargestScale);
    number_of("picture_dpi", "dpi of pictures that are saved", &WrittenPictures::dpi, 0,
              interaction::kMostDpi);
    const std::string size =
        now.width > 0 ? fmt::format("{} x {}", now.width, now.height) : "as in the window";
    lines
        .add({.name = "picture_size",
              .words = "size of pictures and movies",
              .value = size,
              .commands =
                  changed([](WrittenPictures& pictures) { pictures.width = pictures.height = 0; })})
        .with_number = [changed](double number) { // 16 to 9
        const auto width = static_cast<std::uint32_t>(
            std::clamp(std::round(number), 64.0, double{interaction::kLargestPicture}));
        const std::uint32_t height = width * 9 / 16;
        return NumberEffect{fmt::format("{} x {}", width, height),
                            changed([=](WrittenPictures& pictures) {
                                pictures.width = width;
                                pictures.height = height;
                            })};
    };
    for (const index::SurfaceFormat& format : index::surface_formats()) {
        SearchLine& line =
            lines.add({.name = fmt::format("export_surfaces={}", format.name),
                       .words = fmt::format("export the surfaces as {}", format.name),
                       .commands = changed([&](WrittenPictures& pictures) {
                           pictures.surfaces.format = format.name;
                       })});
        line.commands.exporting = interaction::ExportWork{.goes_on = true};
    }
    if (!model.movies.offered)
        return;
    const auto movie = [&](const char* name, const char* words, MovieWish wish) {
        lines.add({.name = name, .words = words, .movie = wish, .in_room = false});
    };
    movie("figure_of_view", "make a figure of this view (PDF)", MovieWish::figure);
    if (interaction::story_step(model.asked.keys, 0).of > 0)
        movie("story_file", "save as story: a file of the keys that have texts", MovieWish::story);
    movie("record", model.recording ? "end the recording of this session" : "record this session",
          MovieWish::record);
    if (model.movies.progress) {
        movie("movie", "cancel the movie", MovieWish::give_up);
        return;
    }
    if (last_step(model) > 0)
        movie("movie", "make a movie of these steps with this view", MovieWish::series);
    movie("movie_of_turn", "make a movie of one turn", MovieWish::turn);
    if (last_step(model) > 0)
        movie("movie_of_both", "make a movie of one turn while time plays", MovieWish::both);
    if (model.asked.keys.size() > 1)
        movie("movie_of_keys", "make a movie of the key frames", MovieWish::keys);
    if (model.asked.keys.size() > 1 && has_titles(model.asked.keys))
        movie("movie_titled", "make a movie of the key frames with titles", MovieWish::titled);
    if (model.asked.views.size() > 1)
        movie("movie_of_views", "make a movie along the saved viewpoints", MovieWish::views);
    if (model.movies.recorded)
        movie("movie_of_recording", "make a movie of the recording so far", MovieWish::recording);
    lines
        .add({.name = "movie_rate",
              .words = "pictures a second of movies",
              .value = fmt::format("{:.4g}", now.rate),
              .commands = changed(
                  [](WrittenPictures& pictures) { pictures.rate = WrittenPictures{}.rate; }),
              .in_room = false})
        .with_number = [changed](double number) {
        const double rate =
            std::clamp(number, interaction::kSlowestMovie, interaction::kFastestMovie);
        return NumberEffect{fmt::format("{:.4g}", rate),
                            changed([=](WrittenPictures& pictures) { pictures.rate = rate; })};
    };
}

/// The keys of the film, and the steps of the story.
void add_film(Lines& lines) {
    const PanelModel& model = lines.model();
    const auto& keys = model.asked.keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string number = fmt::format("key {}", i + 1), &name = keys[i].name;
        Commands way = interaction::way_to_key(keys[i], model.asked, model.head);
        if (!way.room_from_physical) // so that also one that is seen already can be chosen
            way.room_from_physical = model.asked.room_from_physical;
        lines.add({.name = fmt::format("key={}", i + 1),
                   .words = name.empty() ? number : fmt::format("key {}", name),
                   .others = "key frame, keyframe, go to key, " + number,
                   .commands = std::move(way)});
        if (!keys[i].text.empty())
            lines.value(fmt::format("story={}", i + 1),
                        fmt::format("story: tell {}", interaction::name_of_key(keys, i)),
                        &Commands::story, static_cast<std::uint32_t>(i) + 1, model.asked.story);
    }
}

void add_data(Lines& lines) {
    const PanelModel& model = lines.model();
    lines.control("data", "data: values, size and grid", grid_words(model.info), kData);
    lines.control("array", "array of the surfaces", model.info.array, kData);
    for (std::size_t i = 0; i < model.arrays.names.size(); ++i)
        if (i != model.arrays.asked)
            lines.add({.name = "array=" + model.arrays.names[i],
                       .words = "array: " + model.arrays.names[i],
                       .commands = model.arrays.way_to(i)});
    for (std::size_t i = 0; i < model.sessions.size(); ++i)
        lines.add({.name = "session=" + model.sessions[i].file.filename().string(),
                   .words = "session: " + model.sessions[i].words,
                   .others = "continue, resume, restore state, load session, earlier work, go on",
                   .commands = model.sessions[i].commands,
                   .session = i,
                   .in_room = false});
}

} // namespace

const std::vector<KeyCommand>& key_commands() {
    static const std::vector<KeyCommand> all = all_key_commands();
    return all;
}

std::vector<interaction::WindowEvent> presses_of(const KeyCommand& command) {
    const auto modifiers = command.chord == Chord::none
                               ? std::uint8_t{0}
                               : static_cast<std::uint8_t>(Modifier::control);
    std::vector<interaction::WindowEvent> events;
    const auto add = [&](Key key, bool down) {
        events.emplace_back(KeyEvent{key, down, modifiers});
    };
    const bool shift = command.chord == Chord::control_shift;
    if (shift)
        add(Key::left_shift, true);
    add(command.key, true);
    add(command.key, false);
    if (shift)
        add(Key::left_shift, false);
    return events;
}

std::vector<SearchLine> search_lines(const PanelModel& model) {
    Lines lines(model);
    add_way_out(lines);
    add_keys(lines);
    add_surfaces(lines);
    add_ghosts(lines);
    add_coloring(lines);
    add_look(lines);
    add_view(lines);
    add_tools(lines);
    add_time(lines);
    add_curves(lines);
    add_objects(lines);
    add_models(lines);
    add_film(lines);
    add_pictures(lines);
    add_data(lines);
    return lines.take();
}

std::vector<std::string_view> controls_with_other_names() {
    std::vector<std::string_view> controls;
    for (const OtherNames& row : kOtherNames)
        controls.push_back(row.control);
    return controls;
}

} // namespace isochron::app
