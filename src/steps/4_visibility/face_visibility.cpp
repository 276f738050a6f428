#include "steps/4_visibility/face_visibility.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "model/camera.h"
#include "steps/4_visibility/walk.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

using Eigen::Vector3d;

std::array<Vector3d, 3> facet_corners(const TetMesh& mesh, const CellFacet& facet)
{
    const auto& [a, b, c] = kFacetCorners[facet.slot];
    const auto& vertices = mesh.cells[facet.cell].vertices;
    return {mesh.positions[vertices[a]], mesh.positions[vertices[b]], mesh.positions[vertices[c]]};
}

/// The number of views that saw a corner from the front, minimum over the corners.
std::int32_t face_support(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    const Vector3d normal = face_normal(mesh.positions, face);
    const auto views_before = [&](std::uint32_t vertex) -> std::ptrdiff_t {
        if (mesh.points[vertex] == kNoPoint) {
            return 0;
        }
        const auto track = scene.tracks[mesh.points[vertex]];
        return std::count_if(track.begin(), track.end(), [&](std::uint32_t view) {
            return is_in_front_of(scene.views[view].center, mesh.positions[vertex], normal);
        });
    };
    return static_cast<std::int32_t>(
        std::min({views_before(face[0]), views_before(face[1]), views_before(face[2])}));
}

} // namespace

bool is_in_front_of(const Vector3d& center, const Vector3d& place, const Vector3d& normal,
                    double cosine)
{
    const Vector3d way = center - place;
    const double height = normal.dot(way);
    return height > 0.0 && height > cosine * way.norm(); // the sign usually decides, without a root
}

std::vector<Vector3d> places_on(const std::array<Vector3d, 3>& corners)
{
    constexpr std::array<std::array<double, 2>, 6> kSpread = {
        {{0.8, 0.1}, {0.1, 0.8}, {0.1, 0.1}, {0.475, 0.475}, {0.475, 0.05}, {0.05, 0.475}}};
    constexpr double kThin = 0.2;
    const Vector3d& a = corners[0];
    const Vector3d& b = corners[1];
    const Vector3d& c = corners[2];
    const Vector3d middle = (a + b + c) / 3.0;
    std::vector<Vector3d> places = {middle};
    for (const auto& [u, v] : kSpread) {
        places.emplace_back(u * a + v * b + (1.0 - u - v) * c);
    }
    const auto [short_edge, long_edge] =
        std::minmax({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (short_edge < kThin * long_edge) {
        for (const Vector3d& corner : corners) {
            places.emplace_back(corner + (short_edge / long_edge) * (middle - corner));
        }
    }
    return places;
}

std::vector<Vector3d> grid_on(const std::array<Vector3d, 3>& corners, int to_a_side)
{
    const auto& [a, b, c] = corners;
    std::vector<Vector3d> places;
    for (int i = 0; i < to_a_side; ++i) {
        for (int j = 0; i + j < to_a_side; ++j) {
            const double u = (i + 1.0 / 3.0) / to_a_side;
            const double v = (j + 1.0 / 3.0) / to_a_side;
            places.emplace_back(a + u * (b - a) + v * (c - a));
        }
    }
    return places;
}

FaceVisibility::FaceVisibility(const TetMesh& cells, const Labels& labels, const Scene& scene)
    : cells_(cells), labels_(labels), scene_(scene), views_(scene)
{
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : cells.positions) {
        box.extend(position);
    }
    if (!box.isEmpty()) reach_ = 2.0 * box.diagonal().norm();
}

std::array<Vector3d, 3> FaceVisibility::corners_of(const CellFacet& facet) const
{
    return facet_corners(cells_, facet);
}

Vector3d FaceVisibility::outward(const CellFacet& facet) const
{
    const auto [a, b, c] = corners_of(facet); // counter-clockwise from inside
    return scaled_normal(a, c, b);
}

std::vector<Vector3d> FaceVisibility::places_on(const CellFacet& facet) const
{
    return vcarve::places_on(corners_of(facet));
}

/// Whether a view is in front of a facet, and its image shows a position on the facet.
bool FaceVisibility::faces(std::uint32_t view, const CellFacet& facet, const Vector3d& place,
                           double cosine) const
{
    const View& eye = scene_.views[view];
    return is_in_front_of(eye.center, place, outward(facet).normalized(), cosine) &&
           view_shows(eye, scene_.cameras[eye.camera], place);
}

/// Whether a ray from `facet` to a view is unoccluded at `ahead`, the facet that it crosses next.
/// Both cells are tested, because the ray may have entered an inside cell by an edge or vertex.
bool FaceVisibility::is_free(const CellFacet& ahead, const CellFacet& facet) const
{
    return (ahead.cell == facet.cell || labels_[ahead.cell] == Label::outside) &&
           labels_[cells_.other_side(ahead).cell] == Label::outside;
}

bool FaceVisibility::sees(std::uint32_t view, const CellFacet& facet, const Vector3d& place) const
{
    if (!faces(view, facet, place)) return false;
    const auto continues = [&](const CellFacet& ahead) { return is_free(ahead, facet); };
    const Vector3d& center = scene_.views[view].center;
    return RayWalk(cells_).through_facet(facet, place, center, continues).cell == kInfinite;
}

bool FaceVisibility::is_seen(const CellFacet& facet) const
{
    const std::vector<Vector3d> places = places_on(facet);
    const auto sees_some = [&](std::uint32_t view) {
        return std::ranges::any_of(places,
                                   [&](const Vector3d& place) { return sees(view, facet, place); });
    };
    if (any_view_of_corners(facet, sees_some)) return true;
    return std::ranges::any_of(places, [&](const Vector3d& place) {
        return any_near_view(facet, place,
                             [&](std::uint32_t view) { return sees(view, facet, place); });
    });
}

bool FaceVisibility::has_reliable_visibility(const CellFacet& facet) const
{
    const Vector3d normal = outward(facet).normalized();
    return std::ranges::all_of(kFacetCorners[facet.slot], [&](int corner) {
        const Index vertex = cells_.cells[facet.cell].vertices[corner];
        const Vector3d& place = cells_.positions[vertex];
        bool is_seen = false;
        for (const std::uint32_t view : scene_.tracks[vertex]) {
            const View& eye = scene_.views[view];
            if (!is_in_front_of(eye.center, place, normal)) continue;
            if (view_shows(eye, scene_.cameras[eye.camera], place)) return true;
            is_seen = true;
        }
        return !is_seen;
    });
}

/// The boundary facet, if any, that a line crosses when it leaves the cell of `ahead` by `ahead`.
FaceVisibility::Crossed FaceVisibility::crossed_at(const CellFacet& ahead) const
{
    const CellFacet beyond = cells_.other_side(ahead);
    const bool leaves = labels_[ahead.cell] == Label::inside;
    if (leaves == (labels_[beyond.cell] == Label::inside)) return {ahead, Meets::nothing};
    return leaves ? Crossed{ahead, Meets::back} : Crossed{beyond, Meets::front};
}

bool FaceVisibility::along_boundary(const CellFacet& facet, const Vector3d& place,
                                    const Vector3d& target,
                                    const std::function<bool(const Crossed&)>& continues) const
{
    bool passes = false; // whether it has crossed the facet itself, which comes first
    const auto look = [&](const CellFacet& ahead) {
        const Crossed met = crossed_at(ahead);
        if (met.side == Meets::nothing) return true;
        if (passes) return continues(met);
        passes = true;
        return true;
    };
    RayWalk(cells_).through_facet(facet, place, target, look);
    return passes;
}

bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Vector3d& normal)
{
    const auto track = scene.tracks[point];
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return is_in_front_of(scene.views[view].center, scene.positions[point], normal);
    });
}

bool is_seen(const Scene& scene, const Face& points, const Vector3d& normal)
{
    return std::ranges::all_of(
        points, [&](std::uint32_t point) { return is_seen_from_front(scene, point, normal); });
}

FaceFlags faces_seen_at_corners(const TriMesh& mesh, const Scene& scene)
{
    FaceFlags seen(mesh.faces.size());
    parallel_for(seen.size(), [&](std::size_t i) {
        const auto& [a, b, c] = mesh.faces[i];
        seen[i] = is_seen(scene, {mesh.points[a], mesh.points[b], mesh.points[c]},
                          face_normal(mesh.positions, mesh.faces[i]))
                      ? 1
                      : 0;
    });
    return seen;
}

std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene)
{
    std::vector<std::int32_t> supports(mesh.faces.size());
    parallel_for(supports.size(),
                 [&](std::size_t i) { supports[i] = face_support(mesh, scene, mesh.faces[i]); });
    return supports;
}

} // namespace vcarve
