#include "page/comparison_scene.h"

#include "base/statistics.h"
#include "compare/worst_places.h"
#include "model/extent.h"
#include "page/display_mesh.h"
#include "page/pack.h"
#include "page/page_scene.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kPartShare = 0.005;     ///< of the diagonal: maximum step between distances
constexpr std::int64_t kParts = 300'000; ///< maximum number of small faces per surface
constexpr double kScales[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05};
constexpr double kMostArea = 0.9;

/// A mesh to draw and its copy to measure.
struct Compared {
    const NamedMesh& named;
    MeasuredMesh measured;
};

/// The surface that a mesh is measured against.
struct Target {
    std::string name; ///< empty: none
    const TriangleTree* surface = nullptr;
};

Target target_of(std::size_t mesh, const std::vector<Compared>& all, const Reference& reference)
{
    if (reference.truth) return {"the truth", &reference.truth->surface.tree};
    if (all.size() < 2) return {};
    const Compared& other = all[mesh == 0 ? 1 : 0];
    return {other.named.name, &other.measured.tree};
}

/// Moves the result of packed_scene() by `shift`.
void move_scene(Json& scene, const Eigen::Vector3d& shift)
{
    const auto move = [&](Json& place) {
        for (int axis = 0; axis < 3; ++axis) {
            Json& coordinate = place[static_cast<std::size_t>(axis)];
            coordinate = coordinate.get<double>() + shift[axis];
        }
    };
    move(scene["points"]["positions"]["low"]);
    for (Json& view : scene["views"]) {
        move(view["center"]);
    }
}

Json middle_json(const Reference& reference)
{
    const Eigen::AlignedBox3d box = reference.truth ? middle_box(reference.truth->samples, 0.0)
                                                    : middle_box(reference.scene.positions);
    return {{"center", vector_json(box.center())}, {"radius", 0.5 * diagonal_of(reference)}};
}

Json surface_json(const std::string& name, const TriMesh& shown, std::size_t of)
{
    Json json = packed_mesh(shown, of);
    json["name"] = name;
    json["is_truth"] = false;
    for (const char* part : {"measured_to", "distances", "wrong", "missing"}) {
        json[part] = nullptr;
    }
    return json;
}

/// Distances in percent of the diagonal, packed like errors.
std::string packed_distances(const std::vector<Eigen::Vector3d>& places, const TriangleTree& target,
                             double diagonal)
{
    std::vector<double> distances = distances_to(target, places);
    for (double& distance : distances) {
        distance *= 100.0 / diagonal;
    }
    return pack_errors(distances);
}

Json distances_json(const TriMesh& shown, const TriangleTree& target, double diagonal)
{
    const std::vector<std::int32_t> parts = edge_parts(shown, kPartShare * diagonal, kParts);
    return {{"parts", pack_bytes(parts)},
            {"vertices", packed_distances(shown.positions, target, diagonal)},
            {"between", packed_distances(grid_places(shown, parts), target, diagonal)}};
}

Json places_json(const std::vector<WorstPlace>& places)
{
    Json json = Json::array();
    for (const WorstPlace& place : places) {
        json.push_back({{"position", vector_json(place.position)},
                        {"distance", place.distance},
                        {"towards", vector_json(place.towards)},
                        {"reach", place.reach > 0.0 ? Json(place.reach) : Json(nullptr)},
                        {"views", place.views ? Json(*place.views) : Json(nullptr)}});
    }
    return json;
}

double scale_of(double distance)
{
    const auto* const scale =
        std::ranges::find_if(kScales, [&](double s) { return s >= distance; });
    return scale == std::end(kScales) ? kScales[std::size(kScales) - 1] : *scale;
}

/// Adds distances and worst positions. Returns the distance that 90 % of the area does not exceed.
double add_distances(Json& surface, const TriMesh& shown, const MeasuredMesh& mesh,
                     const Target& target, const Reference& reference)
{
    if (target.surface == nullptr) return 0.0;
    constexpr std::size_t kPlaces = ComparisonLimits().places;
    SurfaceDistances far = surface_distances(mesh, *target.surface, reference);
    const bool has_truth = reference.truth.has_value();
    surface["measured_to"] = target.name;
    surface["distances"] = distances_json(shown, *target.surface, diagonal_of(reference));
    surface["wrong"] =
        places_json(largest_deviations(mesh, far, reference, has_truth ? kPlaces / 2 : kPlaces));
    if (has_truth) surface["missing"] = places_json(largest_gaps(mesh, reference, kPlaces / 2));
    return quantile_in_place(far.distances, kMostArea);
}

/// The JSON of a mesh with its distances.
struct DrawnMesh {
    Json json;
    double usual_most = 0.0; ///< distance that 90 % of the area does not exceed
};

DrawnMesh draw(const Compared& mesh, const Target& target, const Reference& reference,
               std::int64_t faces, const Progress& progress)
{
    const TriMesh shown =
        display_mesh(in_frame(mesh.named.mesh, reference.origin), faces, progress);
    DrawnMesh drawn{surface_json(mesh.named.name, shown, mesh.named.mesh.faces.size())};
    drawn.usual_most = add_distances(drawn.json, shown, mesh.measured, target, reference);
    return drawn;
}

Json truth_json(const Reference& reference, std::int64_t faces, const Progress& progress)
{
    const TriMesh& truth = reference.truth->surface.mesh;
    Json json = surface_json("truth", display_mesh(truth, faces, progress), truth.faces.size());
    json["is_truth"] = true;
    return json;
}

std::vector<Compared> prepare(std::span<const NamedMesh> meshes, const Reference& reference)
{
    std::vector<Compared> all;
    for (const NamedMesh& mesh : meshes) {
        all.push_back({mesh, place_mesh(mesh, reference)});
    }
    return all;
}

} // namespace

Json comparison_scene(Json scene, const Eigen::Vector3d& scene_offset,
                      std::span<const NamedMesh> meshes, const Reference& reference,
                      const Progress& progress)
{
    const std::vector<Compared> all = prepare(meshes, reference);
    move_scene(scene, scene_offset - reference.origin);
    scene["middle"] = middle_json(reference);
    scene["diagonal"] = diagonal_of(reference);
    scene["diagonal_of"] = reference.truth ? "truth" : "points";
    scene["surfaces"] = Json::array();

    const auto count = std::ssize(all) + (reference.truth ? 1 : 0);
    const ComparisonLimits limits;
    const std::int64_t faces =
        std::min(limits.faces, limits.all_faces / std::max<std::int64_t>(count, 1));
    const auto part = [&](std::size_t i) {
        const double share = 1.0 / static_cast<double>(count);
        return progress.part(share * static_cast<double>(i), share * static_cast<double>(i + 1));
    };
    double most = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        DrawnMesh drawn = draw(all[i], target_of(i, all, reference), reference, faces, part(i));
        most = std::max(most, drawn.usual_most);
        scene["surfaces"].push_back(std::move(drawn.json));
    }
    if (reference.truth)
        scene["surfaces"].push_back(truth_json(reference, faces, part(all.size())));
    scene["scale"] = scale_of(most);
    return scene;
}

} // namespace vcarve
