#include "mesh/straight_rims.h"

#include "geometry/triangle.h"
#include "mesh/face_corners.h"

#include <algorithm>
#include <optional>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kNothing = 1e-6; // but for rounding, far from the origin, too

/// The faces around a vertex on a rim, from one of its neighbours on the rim to the other.
struct Fan {
    std::vector<std::uint32_t> faces;
    std::vector<std::uint32_t> vertices; ///< around the vertex; one more than faces
};

/// Takes vertices out of rims.
class Straightening {
  public:
    Straightening(std::uint32_t first_face, const PlaneOf& plane_of, TriMesh& mesh, FaceFlags& keep)
        : first_face_(first_face),
          plane_of_(plane_of),
          mesh_(mesh),
          keep_(keep),
          faces_at_(mesh.faces, mesh.positions.size(), keep)
    {
    }

    /// Whether the vertex was taken out.
    bool take_out(std::uint32_t vertex)
    {
        const std::optional<Fan> fan = fan_of(vertex);
        if (!fan || !is_straight(vertex, *fan)) return false;
        for (const bool to_last : {true, false}) {
            if (!can_reach(vertex, *fan, to_last)) continue;
            reach(vertex, *fan, to_last);
            return true;
        }
        return false;
    }

    std::vector<std::uint32_t> gone;

  private:
    std::optional<Fan> fan_of(std::uint32_t vertex) const;
    bool is_straight(std::uint32_t vertex, const Fan& fan) const;
    bool can_reach(std::uint32_t vertex, const Fan& fan, bool to_last) const;
    void reach(std::uint32_t vertex, const Fan& fan, bool to_last);
    void remove(std::uint32_t face, std::uint32_t vertex);

    std::uint32_t first_face_;
    const PlaneOf& plane_of_;
    TriMesh& mesh_;
    FaceFlags& keep_;
    VertexFaces faces_at_;
};

/// Nothing unless the faces make one fan in one plane.
std::optional<Fan> Straightening::fan_of(std::uint32_t vertex) const
{
    std::vector<std::uint32_t> left(faces_at_[vertex].begin(), faces_at_[vertex].end());
    if (left.size() < 2 || plane_of_(left[0]) == kNoPlane) return std::nullopt;
    const auto is_elsewhere = [&](std::uint32_t face) {
        return plane_of_(face) != plane_of_(left[0]);
    };
    if (std::ranges::any_of(left, is_elsewhere)) return std::nullopt;
    // The first face is the one whose second corner no other face ends at.
    const auto second = [&](std::uint32_t face) { return turned_to(mesh_.faces[face], vertex)[1]; };
    const auto third = [&](std::uint32_t face) { return turned_to(mesh_.faces[face], vertex)[2]; };
    const auto first = std::ranges::find_if(left, [&](std::uint32_t face) {
        return std::ranges::none_of(
            left, [&](std::uint32_t other) { return third(other) == second(face); });
    });
    if (first == left.end()) return std::nullopt;
    Fan fan{{}, {second(*first)}};
    for (auto next = first; next != left.end();
         next = std::ranges::find_if(
             left, [&](std::uint32_t face) { return second(face) == fan.vertices.back(); })) {
        fan.faces.push_back(*next);
        fan.vertices.push_back(third(*next));
        left.erase(next);
    }
    if (!left.empty()) return std::nullopt;
    return fan;
}

bool Straightening::is_straight(std::uint32_t vertex, const Fan& fan) const
{
    const Vector3d& place = mesh_.positions[vertex];
    const Vector3d before = place - mesh_.positions[fan.vertices.front()];
    const Vector3d after = mesh_.positions[fan.vertices.back()] - place;
    return before.dot(after) > 0.0 &&
           before.cross(after).norm() <= kNothing * before.norm() * after.norm();
}

/// Whether the faces of a fan may reach to its last vertex, or its first: none turns round or
/// loses its area, no edge is there already, and the face that goes may go.
bool Straightening::can_reach(std::uint32_t vertex, const Fan& fan, bool to_last) const
{
    const std::uint32_t target = to_last ? fan.vertices.back() : fan.vertices.front();
    const std::uint32_t goes = to_last ? fan.faces.back() : fan.faces.front();
    if (goes < first_face_) return false;
    for (const std::uint32_t face : fan.faces) {
        if (face == goes) continue;
        const Vector3d now = scaled_normal(mesh_.positions, mesh_.faces[face]);
        const Vector3d then =
            scaled_normal(mesh_.positions, with(mesh_.faces[face], vertex, target));
        if (now.dot(then) <= kNothing * now.squaredNorm()) return false;
        for (const std::uint32_t corner : mesh_.faces[face]) {
            const auto has_corner = [&](std::uint32_t other) {
                return other != goes && std::ranges::count(mesh_.faces[other], corner) > 0;
            };
            if (std::ranges::count(mesh_.faces[goes], corner) == 0 &&
                std::ranges::any_of(faces_at_[target], has_corner)) {
                return false;
            }
        }
    }
    return true;
}

void Straightening::reach(std::uint32_t vertex, const Fan& fan, bool to_last)
{
    const std::uint32_t target = to_last ? fan.vertices.back() : fan.vertices.front();
    const std::uint32_t goes = to_last ? fan.faces.back() : fan.faces.front();
    for (const std::uint32_t corner : mesh_.faces[goes]) {
        remove(goes, corner);
    }
    std::vector<std::uint32_t> at_target(faces_at_[target].begin(), faces_at_[target].end());
    for (const std::uint32_t face : fan.faces) {
        if (face == goes) continue;
        mesh_.faces[face] = with(mesh_.faces[face], vertex, target);
        at_target.push_back(face);
    }
    faces_at_.replace(target, std::move(at_target));
    faces_at_.replace(vertex, {});
    keep_[goes] = 0;
    gone.push_back(goes);
}

void Straightening::remove(std::uint32_t face, std::uint32_t vertex)
{
    std::vector<std::uint32_t> row(faces_at_[vertex].begin(), faces_at_[vertex].end());
    std::erase(row, face);
    faces_at_.replace(vertex, std::move(row));
}

} // namespace

std::vector<std::uint32_t> straighten_rims(std::uint32_t first_vertex, std::uint32_t first_face,
                                           const PlaneOf& plane_of, TriMesh& mesh, FaceFlags& keep)
{
    const auto num_vertices = static_cast<std::uint32_t>(mesh.positions.size());
    if (first_vertex >= num_vertices) return {};
    Straightening straightening(first_face, plane_of, mesh, keep);
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (std::uint32_t vertex = first_vertex; vertex < num_vertices; ++vertex) {
            if (straightening.take_out(vertex)) goes_on = true;
        }
    }
    return std::move(straightening.gone);
}

} // namespace vcarve
