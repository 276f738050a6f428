#include "page/page_scene.h"

#include "base/statistics.h"
#include "geometry/triangle.h"
#include "io/images/calibrated_photo.h"
#include "io/images/encode_image.h"
#include "mesh/vertices.h"
#include "model/camera.h"
#include "model/extent.h"
#include "model/scene_points.h"
#include "model/views.h"
#include "page/display_mesh.h"
#include "page/pack.h"
#include "picture/eye.h"
#include "steps/4_visibility/face_visibility.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

namespace {

using Json = nlohmann::ordered_json;

/// At most `count` evenly spaced numbers below `of`: i * of / count.
std::vector<std::size_t> evenly_chosen(std::size_t of, std::size_t count)
{
    std::vector<std::size_t> chosen(std::min(of, count));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        chosen[i] = i * of / chosen.size();
    }
    return chosen;
}

/// "count", and the members of pack_positions(): "low", "quantum" and "data".
Json positions_json(std::span<const Eigen::Vector3d> positions)
{
    const PackedPositions packed = pack_positions(positions);
    return {{"count", positions.size()},
            {"low", vector_json(packed.low)},
            {"quantum", vector_json(packed.quantum)},
            {"data", packed.data}};
}

Json points_json(const Scene& scene, std::size_t limit)
{
    std::vector<Eigen::Vector3d> positions;
    std::vector<Color> colors;
    for (const std::size_t point : evenly_chosen(scene.num_points(), limit)) {
        positions.push_back(scene.positions[point]);
        colors.push_back(scene.colors[point]);
    }
    return {{"of", scene.num_points()},
            {"positions", positions_json(positions)},
            {"colors", pack_colors(colors)}};
}

/// Half the width and height of an image at distance 1; nothing if unknown. Images of very wide
/// lenses are reduced to their center.
std::optional<Eigen::Vector2d> half_size(const Camera& camera)
{
    constexpr double kWidest = 1.5;
    const std::optional<Intrinsics> lens = intrinsics(camera);
    if (!lens.has_value() || camera.width_px == 0 || camera.height_px == 0) return std::nullopt;
    const Eigen::Vector2d size_px(static_cast<double>(camera.width_px),
                                  static_cast<double>(camera.height_px));
    const Eigen::Vector2d half = 0.5 * size_px.cwiseQuotient(lens->focal_px);
    return half * std::min(1.0, kWidest / half.maxCoeff());
}

Json view_json(const View& view, const Camera& camera)
{
    const Eigen::Matrix3d world_from_cam = view.cam_from_world.conjugate().toRotationMatrix();
    Json json = {{"name", view.name},
                 {"center", vector_json(view.center)},
                 {"right", vector_json(world_from_cam.col(0))},
                 {"down", vector_json(world_from_cam.col(1))},
                 {"forward", vector_json(world_from_cam.col(2))},
                 {"half_size", nullptr}};
    const std::optional<Eigen::Vector2d> half = half_size(camera);
    if (half.has_value()) json["half_size"] = {half->x(), half->y()};
    return json;
}

Json views_json(const Scene& scene, const std::vector<std::size_t>& shown)
{
    Json views = Json::array();
    for (const std::size_t view : shown) {
        views.push_back(view_json(scene.views[view], scene.cameras[scene.views[view].camera]));
    }
    return views;
}

/// The shown view that sees most of the observed region, and the median depth of its points.
Json start_json(const Scene& scene, const std::vector<std::size_t>& shown)
{
    std::vector<std::vector<double>> depths(scene.views.size());
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            const View& from = scene.views[view];
            depths[view].push_back(
                (from.cam_from_world * (scene.positions[point] - from.center)).z());
        }
    }
    const std::vector<std::size_t> places = seen_places(scene);
    const auto best =
        std::ranges::max_element(shown, {}, [&](std::size_t view) { return places[view]; });
    if (best == shown.end() || depths[*best].empty()) return nullptr;
    return {{"view", best - shown.begin()}, {"depth", median(depths[*best])}};
}

Json attributes_json(const TriMesh& mesh, const Scene& scene)
{
    std::vector<std::int32_t> num_views(mesh.positions.size(), 0);
    std::vector<double> errors_px(mesh.positions.size(), -1.0);
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const std::uint32_t point = mesh.points[vertex];
        if (point == kNoPoint) continue;
        num_views[vertex] = static_cast<std::int32_t>(scene.tracks[point].size());
        if (scene.kind_of(point) == PointKind::measured) errors_px[vertex] = scene.errors_px[point];
    }
    return {{"num_views", pack_bytes(num_views)},
            {"errors", pack_errors(errors_px)},
            {"supports", pack_bytes(face_supports(mesh, scene))}};
}

/// The indices of at most `count` faces, the largest, ascending. Ties prefer the first.
std::vector<std::size_t> largest_faces(const TriMesh& mesh, std::size_t count)
{
    std::vector<std::size_t> faces(mesh.faces.size());
    std::iota(faces.begin(), faces.end(), std::size_t{0});
    if (faces.size() <= count) return faces;
    std::vector<double> areas(faces.size());
    std::ranges::transform(mesh.faces, areas.begin(),
                           [&](const Face& face) { return face_area(mesh.positions, face); });
    const auto is_larger = [&](std::size_t a, std::size_t b) {
        return areas[a] != areas[b] ? areas[a] > areas[b] : a < b;
    };
    std::ranges::nth_element(faces, faces.begin() + static_cast<std::ptrdiff_t>(count), is_larger);
    faces.resize(count);
    std::ranges::sort(faces);
    return faces;
}

} // namespace

Json vector_json(const Eigen::Vector3d& vector)
{
    return {vector.x(), vector.y(), vector.z()};
}

Json packed_mesh(const TriMesh& mesh, std::size_t of)
{
    return {{"of", of},
            {"positions", positions_json(mesh.positions)},
            {"faces", {{"count", mesh.faces.size()}, {"data", pack_faces(mesh.faces)}}},
            {"colors", mesh.colors.empty() ? Json(nullptr) : Json(pack_colors(mesh.colors))}};
}

Json packed_removed(const RemovedFaces& removed, const PageLimits& limits)
{
    std::vector<Face> faces;
    std::vector<std::int32_t> reasons;
    for (const std::size_t face : largest_faces(removed.mesh, limits.removed)) {
        faces.push_back(removed.mesh.faces[face]);
        reasons.push_back(static_cast<std::int32_t>(removed.reasons[face]));
    }
    const auto vertices = used_vertices(faces, removed.mesh.positions.size());
    renumber(faces, vertices, removed.mesh.positions.size());
    Json counts = Json::array();
    for (std::size_t reason = 0; reason < kRemovalNames.size(); ++reason) {
        const auto count = std::ranges::count(removed.reasons, static_cast<Removal>(reason));
        if (count == 0) continue;
        counts.push_back({{"reason", reason}, {"name", kRemovalNames[reason]}, {"of", count}});
    }
    return {{"of", removed.mesh.faces.size()},
            {"reasons", counts},
            {"positions", positions_json(values_at(vertices, removed.mesh.positions))},
            {"faces", {{"count", faces.size()}, {"data", pack_faces(faces)}}},
            {"why", pack_bytes(reasons)}};
}

Json packed_surface(const TriMesh& mesh, const Scene& scene, const PageLimits& limits,
                    const Progress& progress)
{
    const TriMesh shown = display_mesh(mesh, limits.faces, progress);
    Json json = packed_mesh(shown, mesh.faces.size());
    json.update(attributes_json(shown, scene));
    return json;
}

Json packed_depth(const DepthPicture& picture, const Scene& scene)
{
    if (picture.depth.rgb.empty()) return nullptr;
    constexpr int kQuality = 90;
    return {{"name", scene.views[picture.view].name},
            {"photograph", base64(encode_jpeg(picture.photograph, kQuality))},
            {"depth", base64(encode_jpeg(picture.depth, kQuality))}};
}

Json packed_texture(const Texture& texture, const PageLimits& limits)
{
    if (texture.is_empty()) return nullptr;
    constexpr int kQuality = 80;
    std::vector<Photograph> pages = texture.pages;
    const auto texels = [&] {
        std::size_t sum = 0;
        for (const Photograph& page : pages) {
            sum += page.rgb.size() / 3;
        }
        return sum;
    };
    while (texels() > limits.texels) {
        std::ranges::transform(pages, pages.begin(), halved);
    }
    Json images = Json::array();
    for (const Photograph& page : pages) {
        images.push_back(base64(encode_jpeg(page, kQuality)));
    }
    std::vector<std::uint16_t> places;
    places.reserve(6 * texture.places.size());
    for (const auto& corners : texture.places) {
        for (const Eigen::Vector2f& corner : corners) {
            for (const float coordinate : corner) {
                places.push_back(static_cast<std::uint16_t>(
                    std::lround(65535.0F * std::clamp(coordinate, 0.0F, 1.0F))));
            }
        }
    }
    const std::vector<std::int32_t> page_of_face(texture.page_of_face.begin(),
                                                 texture.page_of_face.end());
    return {
        {"pages", images}, {"places", pack_two_bytes(places)}, {"page", pack_bytes(page_of_face)}};
}

Json packed_scene(const Scene& scene, const PageLimits& limits)
{
    const std::vector<std::size_t> shown = evenly_chosen(scene.views.size(), limits.views);
    return {{"up", vector_json(up_of(scene))},
            {"start", start_json(scene, shown)},
            {"points", points_json(scene, limits.points)},
            {"views_of", scene.views.size()},
            {"views", views_json(scene, shown)}};
}

} // namespace vcarve
