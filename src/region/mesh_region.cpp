#include "geometry/point_order.h"
#include "geometry/predicates.h"
#include "geometry/triangle_tree.h"
#include "mesh/edge_table.h"
#include "model/scene_check.h"
#include "region/region.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <array>
#include <random>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

class MeshRegion final : public Region {
  public:
    explicit MeshRegion(TriMesh surface) : surface_(std::move(surface)), tree_(surface_)
    {
        for (const Vector3d& position : surface_.positions) {
            bounds_.extend(position);
        }
    }

    /// Exact: counts the faces that a segment to a position outside the box crosses. A segment
    /// that meets an edge or vertex is replaced by another.
    bool contains(const Vector3d& place) const override
    {
        if (tree_.is_empty() || !bounds_.contains(place)) return false;
        // Far enough for directions to differ, even if the surface is tiny
        const double reach = 2.0 * (bounds_.min().norm() + bounds_.max().norm());
        std::mt19937 random(1); // same sequence on every platform
        while (true) {
            Vector3d way;
            for (double& coordinate : way) {
                coordinate = static_cast<double>(random()) - 2147483647.5;
            }
            const Vector3d outside = place + reach * way.normalized();
            Crossings crossings;
            tree_.visit_met(place, outside, [&](std::size_t face) {
                add_crossing(surface_.faces[face], place, outside, crossings);
            });
            if (crossings.begins_on_face) return true;
            if (!crossings.is_ambiguous) return crossings.count % 2 == 1;
        }
    }
    bool meets(const Vector3d& from, const Vector3d& to) const override
    {
        return contains(from) || (from != to && tree_.is_met(from, to));
    }
    Eigen::AlignedBox3d bounds() const override { return bounds_; }

  private:
    /// The faces that a segment crosses.
    struct Crossings {
        std::size_t count = 0;
        bool begins_on_face = false;
        bool is_ambiguous = false; ///< meets an edge or vertex, or runs along a face
    };

    /// Adds a face that the segment meets. `to` must be outside the surface.
    void add_crossing(const Face& face, const Vector3d& from, const Vector3d& to,
                      Crossings& crossings) const
    {
        const std::array<Vector3d, 3> corners = {
            surface_.positions[face[0]], surface_.positions[face[1]], surface_.positions[face[2]]};
        const bool ends_in_plane = orientation(corners[0], corners[1], corners[2], to) == 0;
        if (!ends_in_plane && orientation(corners[0], corners[1], corners[2], from) == 0) {
            crossings.begins_on_face = true;
        }
        bool meets_edge = ends_in_plane;
        for (std::size_t i = 0; i < 3; ++i) {
            meets_edge = meets_edge || orientation(from, to, corners[i], corners[(i + 1) % 3]) == 0;
        }
        crossings.is_ambiguous = crossings.is_ambiguous || meets_edge;
        ++crossings.count;
    }

    TriMesh surface_;
    TriangleTree tree_;
    Eigen::AlignedBox3d bounds_;
};

/// Merges vertices with equal positions.
void unite_vertices(TriMesh& surface)
{
    const std::vector<std::uint32_t> by_place = lexicographic_sort(surface.positions);
    std::vector<std::uint32_t> first_there(surface.positions.size());
    for (std::size_t i = 0; i < by_place.size(); ++i) {
        const bool is_same =
            i > 0 && surface.positions[by_place[i]] == surface.positions[by_place[i - 1]];
        first_there[by_place[i]] = is_same ? first_there[by_place[i - 1]] : by_place[i];
    }
    for (Face& face : surface.faces) {
        for (std::uint32_t& corner : face) {
            corner = first_there[corner];
        }
    }
}

void require_closed(const TriMesh& surface, const std::filesystem::path& path)
{
    const EdgeTable edges = gather_edges(surface.faces, surface.positions.size());
    std::size_t open = 0;
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        open += edges[edge].size() % 2;
    }
    if (open > 0) {
        throw InputError(fmt::format("{}: found {} of {} edges that bound an odd number of faces, "
                                     "expected a closed surface",
                                     path.string(), open, edges.size()));
    }
    if (edges.size() == 0) {
        throw InputError(
            fmt::format("{}: found no face, expected a closed surface", path.string()));
    }
}

} // namespace

std::unique_ptr<Region> read_mesh_region(const std::filesystem::path& path, const Vector3d& offset)
{
    TriMesh surface = read_ply(path);
    unite_vertices(surface);
    require_closed(surface, path);
    for (Vector3d& position : surface.positions) {
        position += surface.offset - offset;
        if (is_valid_position(position)) continue;
        throw InputError(fmt::format("{}: found a vertex farther than {} from the origin, expected "
                                     "a surface in the frame of the model",
                                     path.string(), kFarthest));
    }
    return std::make_unique<MeshRegion>(std::move(surface));
}

} // namespace vcarve
