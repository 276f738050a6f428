#include "base/stage_counts.h"
#include "base/text.h"
#include "io/images/find_photographs.h"
#include "mesh/collapse_edges.h"
#include "mesh/half_edge_mesh.h"
#include "model/camera.h"
#include "photo_refine/refine_mesh.h"
#include "pipeline/run_state.h"
#include "pipeline/stages.h"
#include "steps/6_surface/cleanup.h"
#include "stereo/fuse.h"
#include "texture/masked_faces.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::stage_runs {

namespace {

/// The photographs whose lens is known, in the frame of a mesh with this offset.
std::vector<CalibratedPhoto> usable_photos(const RunState& run, const Eigen::Vector3d& offset)
{
    const Photographs& photographs = *run.images->photographs;
    std::vector<CalibratedPhoto> photos = calibrated_photos(run.points.scene, photographs, offset);
    const auto found =
        std::ranges::count_if(photographs.of_view, [](const auto& file) { return !file.empty(); });
    if (photos.empty()) {
        throw InputError(fmt::format("{}: no photograph can be used, because the views have an "
                                     "unknown lens or no image size; expected one of COLMAP's "
                                     "camera models",
                                     photographs.folder.string()));
    }
    if (const auto left_out = size_of(found) - size_of(photos.size()); left_out > 0) {
        run.log.note(
            fmt::format("photographs ignored because their lens is unknown: {}", left_out));
    }
    return photos;
}

/// Photographs that can be undistorted to pinhole images: not panoramas.
std::vector<CalibratedPhoto> photos_with_pinhole(const RunState& run, const Eigen::Vector3d& offset)
{
    std::vector<CalibratedPhoto> photos =
        calibrated_photos(run.points.scene, *run.images->photographs, offset);
    std::erase_if(photos, [](const CalibratedPhoto& photo) { return !intrinsics(photo.camera); });
    if (photos.size() < 3) {
        throw InputError(fmt::format("{}: dense points and refinement need at least 3 photographs "
                                     "of views with a known, non-spherical lens, but found {}; "
                                     "name their folder with --images",
                                     run.images->photographs->folder.string(), photos.size()));
    }
    return photos;
}

} // namespace

Counts undistort(RunState& run, const Progress& progress)
{
    run.photos = photos_with_pinhole(run, run.points.scene.offset);
    run.stereo.views = undistort_photos(run.photos, run.options().dense, progress);
    std::vector<std::string> unreadable;
    for (const StereoView& view : run.stereo.views) {
        if (!view.problem.empty()) unreadable.push_back(view.problem);
    }
    note_unusable(unreadable, run.log);
    return {{counts::kDense.photos, size_of(run.photos.size() - unreadable.size())}};
}

Counts match(RunState& run, const Progress& progress)
{
    match_views(run.points.scene, run.surface, run.keep_depth, run.stereo, progress);
    std::int64_t measured = 0;
    std::int64_t pixels = 0;
    for (const DepthMap& map : run.stereo.maps) {
        measured += num_measured(map);
        pixels += size_of(map.planes.size());
    }
    return {{counts::kDense.maps, size_of(run.stereo.maps.size())},
            {counts::kDense.measured, measured, pixels}};
}

Counts fuse(RunState& run, const Progress& progress)
{
    const Scene& sparse = run.points.scene;
    const auto& [views, neighbors, maps] = run.stereo;
    run.dense = vcarve::fuse(sparse, {views, maps, neighbors}, progress);
    Counts fused = {{counts::kDense.points, size_of(run.dense.num_points())},
                    {counts::kDense.fused, size_of(run.dense.num_rays())}};
    add_measured(sparse, run.dense);
    const std::size_t shown = fullest(maps);
    run.depth = depth_picture(views[shown], maps[shown]);
    return fused;
}

Counts remove_masked(RunState& run, const Progress& progress)
{
    const Photographs& masks = *run.images->masks;
    const std::int64_t before = size_of(run.surface.faces.size());
    run.surface = without_masked_faces(
        run.surface, views_with_masks(run.points.scene, masks, run.surface.offset),
        run.options().surface.cleanup.min_component, progress);
    if (run.surface.faces.empty()) {
        throw InputError(fmt::format("the masks in {} exclude all faces; black pixels are "
                                     "excluded, so the masks may need to be inverted",
                                     masks.folder.string()));
    }
    return {{counts::kTexture.masks, size_of(masks.of_view.size() - masks.missing)},
            {counts::kTexture.unmasked, size_of(run.surface.faces.size()), before}};
}

Counts refine_by_photos(RunState& run, const Progress& progress)
{
    run.photos = photos_with_pinhole(run, run.surface.offset);
    const RefinedCounts counts = refine_mesh(run.surface, run.points.scene, run.photos,
                                             run.options().dense.refine_px, progress);
    run.refined_pixel = counts.pixel;
    if (counts.measured == 0) {
        run.notes.emplace_back("refinement found no place where the photographs agree");
    }
    return {{counts::kPhotoRefine.vertices, counts.measured, counts.vertices}};
}

Counts merge_refined(RunState& run, const Progress& /*progress*/)
{
    // Of a pixel of disparity. Matching is about as exact, see collapse_edges() for its meaning.
    constexpr double kExact = 0.075;
    const std::int64_t before = size_of(run.surface.faces.size());
    constexpr CleanupOptions kOnlySplit = {.min_component = 0, .max_hole = 0};
    const int faces = run.options().refine.simplify.faces;
    CollapseLimits limits;
    if (faces == SimplifyOptions::kAutoFaces) {
        limits.max_distance = kExact * run.refined_pixel;
    } else {
        limits.min_faces = static_cast<std::size_t>(faces);
    }
    TriMesh merged = collapse_edges(run.surface, limits);
    run.surface = tri_mesh(*clean_surface(std::move(merged), kOnlySplit).mesh);
    return {{counts::kMerge.faces, size_of(run.surface.faces.size()), before}};
}

Counts find_photos(RunState& run, const Progress& progress)
{
    run.photos = usable_photos(run, run.surface.offset);
    run.shown.of_faces = find_photos_of_faces(run.surface, run.photos, progress);
    const auto seen = std::ranges::count_if(
        run.shown.of_faces, [](const PhotosOfFace& found) { return found.count > 0; });
    return {{counts::kTexture.seen, seen, size_of(run.surface.faces.size())},
            {counts::kTexture.photos, size_of(run.photos.size())}};
}

Counts color(RunState& run, const Progress& progress)
{
    const TextureLimits limits = texture_limits(run.options(), run.images->photographs->sizes);
    const ColoredVertices colored =
        color_mesh(run.surface, run.photos, limits.photos_at_a_time, run.shown, progress);
    note_unusable(run.shown.problems, run.log);
    return {{counts::kTexture.vertices, size_of(colored.vertices)},
            {counts::kTexture.outliers, size_of(colored.outliers)}};
}

Counts paint(RunState& run, const Progress& progress)
{
    const TextureLimits limits = texture_limits(run.options(), run.images->photographs->sizes);
    PaintedTexture painted = paint_texture(run.surface, run.photos, run.shown, limits, progress);
    if (painted.scale < limits.scale) {
        run.notes.push_back(fmt::format("to limit memory, the texture has only {:.2f} texels per "
                                        "photograph pixel (along a side)",
                                        painted.scale));
    }
    const auto bare = std::ranges::count(painted.view_of_face, -1);
    run.texture = std::move(painted.texture);
    return {{counts::kTexture.charts, size_of(painted.charts)},
            {counts::kTexture.pages, size_of(run.texture.pages.size())},
            {counts::kTexture.bare, bare}};
}

} // namespace vcarve::stage_runs
