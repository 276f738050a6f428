#include "sight/face_visibility.h"

#include "model/camera.h"
#include "sight/walk.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

std::array<Vector3d, 3> corners_of(const TetMesh& mesh, const CellFacet& facet)
{
    const auto& [a, b, c] = kFacetCorners[facet.slot];
    const auto& vertices = mesh.cells[facet.cell].vertices;
    return {mesh.positions[vertices[a]], mesh.positions[vertices[b]], mesh.positions[vertices[c]]};
}

/// Towards the outside; not of unit length.
Vector3d outward(const TetMesh& mesh, const CellFacet& facet)
{
    const auto [a, b, c] = corners_of(mesh, facet); // counter-clockwise from inside
    return (c - a).cross(b - a);
}

/// Whether a view stands before a place with this normal, by more than a graze.
bool stands_before(const Vector3d& center, const Vector3d& place, const Vector3d& normal)
{
    constexpr double kGrazing = 0.05; // cosine, about 87 degrees off the normal
    const Vector3d way = center - place;
    const double height = normal.dot(way);
    return height > 0.0 && height > kGrazing * way.norm() * normal.norm();
}

} // namespace

FaceVisibility::FaceVisibility(const TetMesh& cells, const Labels& labels, const Scene& scene)
    : cells_(cells), labels_(labels), scene_(scene)
{
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : cells.positions) {
        box.extend(position);
    }
    if (!box.isEmpty()) reach_ = 2.0 * box.diagonal().norm();
}

FaceVisibility::Places FaceVisibility::places_on(const CellFacet& facet) const
{
    constexpr double kMiddle = 1.0 / 3.0;
    constexpr double kNear = 0.8;
    constexpr double kFar = 0.1;
    constexpr double kHalf = 0.475;
    constexpr double kRim = 0.05;
    const std::array<Vector3d, 3> corners = corners_of(cells_, facet);
    const auto mix = [&](double u, double v) -> Vector3d {
        return u * corners[0] + v * corners[1] + (1.0 - u - v) * corners[2];
    };
    return {mix(kMiddle, kMiddle), mix(kNear, kFar), mix(kFar, kNear), mix(kFar, kFar),
            mix(kHalf, kHalf),     mix(kHalf, kRim), mix(kRim, kHalf)};
}

bool FaceVisibility::sees(std::uint32_t view, const CellFacet& facet, const Vector3d& place) const
{
    const View& eye = scene_.views[view];
    if (!stands_before(eye.center, place, outward(cells_, facet))) return false;
    if (!view_shows(eye, scene_.cameras[eye.camera], place)) return false;
    // Through an edge or a vertex the way may enter inside cells unasked, but not leave them so.
    const auto leads_on = [&](const CellFacet& ahead) {
        return (ahead.cell == facet.cell || labels_[ahead.cell] == Label::outside) &&
               labels_[cells_.other_side(ahead).cell] == Label::outside;
    };
    return SightWalk(cells_).through_facet(facet, place, eye.center, leads_on).cell == kInfinite;
}

bool FaceVisibility::is_seen(const CellFacet& facet) const
{
    const Places places = places_on(facet);
    const auto sees_some = [&](std::uint32_t view) {
        return std::ranges::any_of(places,
                                   [&](const Vector3d& place) { return sees(view, facet, place); });
    };
    for (const int corner : kFacetCorners[facet.slot]) {
        const auto track = scene_.tracks[cells_.cells[facet.cell].vertices[corner]];
        if (std::ranges::any_of(track, sees_some)) return true;
    }
    for (std::uint32_t view = 0; view < scene_.views.size(); ++view) {
        if (sees_some(view)) return true;
    }
    return false;
}

std::vector<FaceVisibility::Crossed> FaceVisibility::boundary_behind(std::uint32_t view,
                                                                     const CellFacet& facet,
                                                                     const Vector3d& place) const
{
    const Vector3d way = (place - scene_.views[view].center).normalized();
    std::vector<Crossed> crossed;
    const auto note = [&](const CellFacet& ahead) {
        const CellFacet beyond = cells_.other_side(ahead);
        const bool leaves = labels_[ahead.cell] == Label::inside;
        if (leaves != (labels_[beyond.cell] == Label::inside)) {
            crossed.push_back(leaves ? Crossed{ahead, Meets::back} : Crossed{beyond, Meets::front});
        }
        return true;
    };
    SightWalk(cells_).through_facet(cells_.other_side(facet), place, place + reach_ * way, note);
    if (!crossed.empty()) crossed.erase(crossed.begin()); // the facet itself
    return crossed;
}

} // namespace vcarve
