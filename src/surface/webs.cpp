#include "surface/webs.h"

#include "surface/extract.h"
#include "surface/face_evidence.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kSmall = 2.0;  ///< relative size up to which a face tells how the surface runs
constexpr double kBent = 0.8;   ///< cosine, about 37 degrees: a face so far off stands across
constexpr double kBefore = 0.2; ///< cosine, about 11 degrees above the surface: a cell is before it

/// Per point of the scene the sum of the normals of the small faces around it; zero where there
/// are none.
std::vector<Vector3d> normals_of_small_faces(const TriMesh& mesh, const std::vector<double>& sizes,
                                             std::size_t num_points)
{
    std::vector<Vector3d> normals(num_points, Vector3d::Zero());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const Vector3d normal = face_normal(mesh, mesh.faces[i]);
        if (sizes[i] < kSmall && normal.allFinite()) {
            for (const std::uint32_t vertex : mesh.faces[i]) {
                normals[mesh.points[vertex]] += normal;
            }
        }
    }
    for (Vector3d& normal : normals) {
        normal.normalize(); // leaves zero as it is
    }
    return normals;
}

/// Whether a face stands across the surface at the corners that know how it runs: at the middle of
/// three, the better of two; one alone tells nothing.
bool stands_across(const TriMesh& mesh, const Face& face, const std::vector<Vector3d>& normals)
{
    const Vector3d normal = face_normal(mesh, face);
    std::array<double, 3> cosines{};
    std::transform(face.begin(), face.end(), cosines.begin(), [&](std::uint32_t vertex) {
        const Vector3d& around = normals[mesh.points[vertex]];
        return around.isZero() ? 1.0 : normal.dot(around);
    });
    std::sort(cosines.begin(), cosines.end());
    return cosines[1] < kBent;
}

/// Whether a cell lies before the surface at one of its corners.
bool lies_before(const TetMesh& mesh, const Cell& cell, const std::vector<Vector3d>& normals)
{
    Vector3d middle = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        middle += 0.25 * mesh.positions[vertex];
    }
    return std::any_of(cell.vertices.begin(), cell.vertices.end(), [&](Index vertex) {
        const Vector3d direction = (middle - mesh.positions[vertex]).normalized();
        return direction.dot(normals[vertex]) >= kBefore;
    });
}

} // namespace

std::vector<Index> cells_behind_webs(const TetMesh& cells, const Labels& labels, const Scene& scene,
                                     const WebOptions& options)
{
    if (options.web_edge == 0.0) {
        return {};
    }
    const TriMesh mesh = extract_surface(cells, labels, scene);
    const FaceFlags seen = seen_faces(mesh, scene);
    const std::vector<double> sizes = relative_sizes(mesh, FaceFlags(mesh.faces.size(), 1));
    const std::vector<Vector3d> normals =
        normals_of_small_faces(mesh, sizes, cells.positions.size());
    const std::vector<Index> behind = cells_behind(cells, labels);
    std::vector<Index> doubted;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        if (seen[i] != 0 && sizes[i] >= options.web_edge &&
            stands_across(mesh, mesh.faces[i], normals) &&
            lies_before(cells, cells.cells[behind[i]], normals)) {
            doubted.push_back(behind[i]);
        }
    }
    return doubted;
}

} // namespace vcarve
