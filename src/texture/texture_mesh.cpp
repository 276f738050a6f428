#include "texture/texture_mesh.h"

#include "texture/charts.h"
#include "texture/choose_photos.h"
#include "texture/paint.h"
#include "texture/seams.h"
#include "texture/vertex_colors.h"

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
                 const std::vector<std::uint32_t>& photo_of_face, const TextureLimits& limits)
{
    constexpr double kPacked = 1.6; // page texels per chart texel
    double texels = 0.0;
    for (std::size_t face = 0; face < photo_of_face.size(); ++face) {
        const int place = place_of(photos_of_faces[face], photo_of_face[face]);
        if (place >= 0) texels += kPacked * photos_of_faces[face].best[place].area_px2;
    }
    return std::min(limits.scale,
                    std::sqrt(static_cast<double>(limits.most_texels) / std::max(texels, 1.0)));
}

} // namespace

TextureLimits texture_limits(const Options& options, std::span<const PhotographSize> photos)
{
    TextureLimits limits = {.scale = options.texture.scale};
    const auto most = static_cast<double>(options.memory.limit);
    if (most <= 0.0) return limits;
    limits.most_texels =
        std::min(limits.most_texels, static_cast<std::size_t>(most / 4.0 / kTexelBytes));
    double largest_px = 1.0;
    for (const PhotographSize& photo : photos) {
        largest_px = std::max(largest_px, static_cast<double>(photo.width_px) * photo.height_px);
    }
    const double fitting = std::floor(most / 2.0 / (kPhotoPixelBytes * largest_px));
    limits.photos_at_a_time = static_cast<std::size_t>(
        std::clamp(fitting, 1.0, static_cast<double>(limits.photos_at_a_time)));
    return limits;
}

ColoredVertices color_mesh(TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                           std::size_t photos_at_a_time, MeshPhotos& shown,
                           const Progress& progress)
{
    ShownColors looked_up =
        look_up_colors(mesh, photos, shown.of_faces, photos_at_a_time, progress);
    shown.colors = std::move(looked_up.colors);
    shown.problems = std::move(looked_up.unreadable);
    shown.gains = find_gains(photos.size(), shown.of_faces, shown.colors);
    const std::size_t outliers = drop_outliers(shown.gains, shown.of_faces, shown.colors);
    return {color_vertices(shown.of_faces, shown.colors, shown.gains, mesh), outliers};
}

PaintedTexture paint_texture(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                             const MeshPhotos& shown, const TextureLimits& limits,
                             const Progress& progress)
{
    PaintedTexture made;
    const auto& [of_faces, colors, gains, problems] = shown;
    const FacesBeside beside = find_faces_beside(mesh);
    const std::vector<std::uint32_t> photo_of_face =
        choose_photos(mesh, photos, of_faces, beside, progress.part(0.0, 0.2));
    made.scale = scale_for(of_faces, photo_of_face, limits);
    const Atlas atlas =
        lay_out_charts(mesh, photos, photo_of_face, beside, {made.scale, limits.most_page_px});
    const CornerLevels levels = level_seams(mesh, of_faces, colors, gains, photo_of_face);
    auto blends = find_blends(mesh, of_faces, photo_of_face, atlas, levels);
    blends.resize(photos.size());
    made.texture = texture_of(atlas, paint_pages({mesh, photos, photo_of_face, atlas, gains, levels,
                                                  blends, limits.photos_at_a_time},
                                                 progress.part(0.3, 1.0)));
    made.view_of_face = views_of(photo_of_face, photos);
    made.charts = atlas.num_charts;
    return made;
}

} // namespace vcarve
