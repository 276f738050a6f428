#include "texture/texture_mesh.h"

#include "base/progress.h"
#include "base/stage_counts.h"
#include "model/camera.h"
#include "texture/charts.h"
#include "texture/choose_photos.h"
#include "texture/face_colors.h"
#include "texture/face_photos.h"
#include "texture/paint.h"
#include "texture/seams.h"
#include "texture/vertex_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vcarve {

namespace {

Texture texture_of(const Atlas& atlas, std::vector<Photograph> pages)
{
    Texture texture{std::move(pages), atlas.page_of_face, {}};
    texture.places.resize(atlas.corners.size());
    for (std::size_t face = 0; face < atlas.corners.size(); ++face) {
        const Eigen::Array2d size = atlas.page_sizes[atlas.page_of_face[face]].cast<double>();
        for (int i = 0; i < 3; ++i) {
            texture.places[face][i] = (atlas.corners[face][i].array() / size).cast<float>();
        }
    }
    return texture;
}

std::vector<std::int32_t> views_of(const std::vector<std::uint32_t>& photo_of_face,
                                   const std::vector<CalibratedPhoto>& photos)
{
    std::vector<std::int32_t> views(photo_of_face.size(), -1);
    for (std::size_t face = 0; face < views.size(); ++face) {
        if (photo_of_face[face] == kNoPhoto) continue;
        views[face] = static_cast<std::int32_t>(photos[photo_of_face[face]].view);
    }
    return views;
}

/// Returns `scale`, or the largest scale that needs at most `most_texels`.
double scale_for(const std::vector<PhotosOfFace>& photos_of_faces,
                 const std::vector<std::uint32_t>& photo_of_face, const TextureOptions& options,
                 Log& log)
{
    constexpr double kPacked = 1.6; // page texels per chart texel
    double texels = 0.0;
    for (std::size_t face = 0; face < photo_of_face.size(); ++face) {
        const int place = place_of(photos_of_faces[face], photo_of_face[face]);
        if (place >= 0) texels += kPacked * photos_of_faces[face].best[place].area_px2;
    }
    const double finest =
        std::sqrt(static_cast<double>(options.most_texels) / std::max(texels, 1.0));
    if (options.scale <= finest) return options.scale;
    log.note(fmt::format("to limit memory, the texture has only {:.2f} texels per photograph pixel "
                         "(along a side)",
                         finest));
    return finest;
}

} // namespace

std::vector<CalibratedPhoto> calibrated_photos(const Scene& scene, const Photographs& photographs,
                                               const Eigen::Vector3d& mesh_offset)
{
    std::vector<CalibratedPhoto> photos;
    const std::vector<double> focals_px = mean_focals_px(scene.cameras);
    for (std::uint32_t i = 0; i < scene.views.size(); ++i) {
        const View& view = scene.views[i];
        const Camera& camera = scene.cameras[view.camera];
        if (photographs.of_view[i].empty() || !project(camera, Eigen::Vector3d::UnitZ()) ||
            camera.width_px == 0 || camera.height_px == 0) {
            continue;
        }
        CalibratedPhoto& photo = photos.emplace_back();
        photo.file = photographs.of_view[i];
        if (!photographs.masks.empty()) photo.mask = photographs.masks[i];
        photo.size = photographs.sizes[i];
        photo.view = i;
        photo.pose = view;
        photo.pose.center += scene.offset - mesh_offset;
        photo.camera = camera;
        photo.scale = {photo.size.width_px / static_cast<double>(camera.width_px),
                       photo.size.height_px / static_cast<double>(camera.height_px)};
        photo.focal_px = focals_px[view.camera] * photo.scale.mean();
    }
    return photos;
}

TexturedMesh texture_mesh(TriMesh mesh, const std::vector<CalibratedPhoto>& photos,
                          const TextureOptions& options, Log& log)
{
    TexturedMesh result;
    std::vector<PhotosOfFace> photos_of_faces;
    {
        Stage stage(log, "photos");
        photos_of_faces = find_photos_of_faces(mesh, photos, stage);
        const auto seen = std::ranges::count_if(
            photos_of_faces, [](const PhotosOfFace& found) { return found.count > 0; });
        stage.end({{counts::kTexture.seen, seen, size_of(mesh.faces.size())},
                   {counts::kTexture.photos, size_of(photos.size())}});
    }
    FaceColors colors;
    Gains gains;
    {
        Stage stage(log, "colors");
        ShownColors shown =
            look_up_colors(mesh, photos, photos_of_faces, options.photos_at_a_time, stage);
        colors = std::move(shown.colors);
        note_unusable(shown.unreadable, log);
        gains = find_gains(photos.size(), photos_of_faces, colors);
        const std::size_t outliers = drop_outliers(gains, photos_of_faces, colors);
        const std::size_t colored = color_vertices(photos_of_faces, colors, gains, mesh);
        stage.end({{counts::kTexture.vertices, size_of(colored)},
                   {counts::kTexture.outliers, size_of(outliers)}});
    }
    if (options.only_colors) {
        result.mesh = std::move(mesh);
        return result;
    }
    Stage stage(log, "texture");
    const Progress progress = stage;
    const FacesBeside beside = find_faces_beside(mesh);
    const std::vector<std::uint32_t> photo_of_face =
        choose_photos(mesh, photos, photos_of_faces, beside, progress.part(0.0, 0.2));
    const double scale = scale_for(photos_of_faces, photo_of_face, options, log);
    const Atlas atlas =
        lay_out_charts(mesh, photos, photo_of_face, beside, {scale, options.most_page_px});
    const CornerLevels levels = level_seams(mesh, photos_of_faces, colors, gains, photo_of_face);
    auto blends = find_blends(mesh, photos_of_faces, photo_of_face, atlas, levels);
    blends.resize(photos.size());
    result.texture = texture_of(atlas, paint_pages({mesh, photos, photo_of_face, atlas, gains,
                                                    levels, blends, options.photos_at_a_time},
                                                   progress.part(0.3, 1.0)));
    result.view_of_face = views_of(photo_of_face, photos);
    result.mesh = std::move(mesh);
    stage.end({{counts::kTexture.charts, size_of(atlas.num_charts)},
               {counts::kTexture.pages, size_of(atlas.page_sizes.size())}});
    return result;
}

} // namespace vcarve
