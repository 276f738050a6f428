#include "surface/webs.h"

#include "base/parallel.h"
#include "surface/extract.h"
#include "surface/face_evidence.h"
#include "surface/local_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kSmall = 2.0;  ///< relative size up to which a face tells how the surface runs
constexpr double kBent = 0.8;   ///< cosine, about 37 degrees: a face so far off stands across
constexpr double kBefore = 0.2; ///< cosine, about 11 degrees above the surface: a cell is before it

/// How the surface runs at points of the scene.
class SurfaceNormals {
  public:
    SurfaceNormals(const std::vector<Vector3d>& positions, const std::vector<Face>& faces,
                   const LocalEdges& edges)
        : positions_(positions), faces_(faces), edges_(edges)
    {
    }

    /// The mean normal of the small faces around a point; zero where there are none.
    Vector3d at(Index point) const
    {
        Vector3d sum = Vector3d::Zero();
        for (const std::uint32_t face : edges_.faces_at()[point]) {
            const Vector3d normal = of(face);
            if (edges_.relative_size(face) < kSmall && normal.allFinite()) sum += normal;
        }
        return sum.normalized(); // leaves zero as it is
    }

    Vector3d of(std::size_t face) const { return face_normal(positions_, faces_[face]); }

  private:
    const std::vector<Vector3d>& positions_;
    const std::vector<Face>& faces_;
    const LocalEdges& edges_;
};

/// Whether a face stands across the surface at the corners that know how it runs: at the middle of
/// three, the better of two; one alone tells nothing.
bool stands_across(const Face& face, const Vector3d& normal, const SurfaceNormals& normals)
{
    std::array<double, 3> cosines{};
    std::transform(face.begin(), face.end(), cosines.begin(), [&](std::uint32_t point) {
        const Vector3d around = normals.at(point);
        return around.isZero() ? 1.0 : normal.dot(around);
    });
    std::sort(cosines.begin(), cosines.end());
    return cosines[1] < kBent;
}

/// Whether a cell lies before the surface at one of its corners.
bool lies_before(const TetMesh& mesh, const Cell& cell, const SurfaceNormals& normals)
{
    Vector3d middle = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        middle += 0.25 * mesh.positions[vertex];
    }
    return std::any_of(cell.vertices.begin(), cell.vertices.end(), [&](Index vertex) {
        const Vector3d direction = (middle - mesh.positions[vertex]).normalized();
        return direction.dot(normals.at(vertex)) >= kBefore;
    });
}

} // namespace

std::vector<Index> cells_behind_webs(const TetMesh& cells, const Labels& labels, const Scene& scene,
                                     const WebOptions& options)
{
    if (options.web_edge == 0.0) {
        return {};
    }
    // Few faces are large, so that everything but their size is cheap.
    const std::vector<BoundaryFacet> facets = boundary_facets(cells, labels);
    const std::vector<Face> faces = boundary_faces(cells, facets);
    const LocalEdges edges(cells.positions, faces);
    const SurfaceNormals normals(cells.positions, faces, edges);
    const std::vector<std::uint32_t> large = edges.large_faces(options.web_edge);
    const auto doubt = [&](std::size_t i, std::vector<Index>& doubted) {
        const std::uint32_t face = large[i];
        const Index behind = facets[face].cell;
        const Vector3d normal = normals.of(face);
        if (edges.relative_size(face) >= options.web_edge && is_seen(scene, faces[face], normal) &&
            stands_across(faces[face], normal, normals) &&
            lies_before(cells, cells.cells[behind], normals)) {
            doubted.push_back(behind);
        }
    };
    return parallel_collect<Index>(large.size(), doubt, 64);
}

} // namespace vcarve
