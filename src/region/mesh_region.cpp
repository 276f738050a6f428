#include "region/mesh_region.h"

#include "geometry/cgal_kernel.h"
#include "geometry/point_order.h"
#include "geometry/predicates.h"
#include "mesh/edge_table.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Triangles = CGAL::Surface_mesh<Kernel::Point_3>;
using Side = CGAL::Side_of_triangle_mesh<Triangles, Kernel>;

/// Faces that share no vertex: CGAL's mesh must be manifold and oriented, a region need not be.
/// Those without an area are left out: they lie on the edges of others.
Triangles loose_triangles(const TriMesh& surface)
{
    Triangles triangles;
    for (const Face& face : surface.faces) {
        const Vector3d& a = surface.positions[face[0]];
        const Vector3d& b = surface.positions[face[1]];
        const Vector3d& c = surface.positions[face[2]];
        if (collinear(a, b, c)) continue;
        triangles.add_face(triangles.add_vertex(to_cgal(a)), triangles.add_vertex(to_cgal(b)),
                           triangles.add_vertex(to_cgal(c)));
    }
    return triangles;
}

class MeshRegion final : public Region {
  public:
    explicit MeshRegion(const TriMesh& surface)
        : triangles_(loose_triangles(surface)),
          tree_(triangles_.faces_begin(), triangles_.faces_end(), triangles_),
          side_(tree_)
    {
        for (const Vector3d& position : surface.positions) {
            bounds_.extend(position);
        }
        tree_.build(); // now, not with the first question
    }

    bool contains(const Vector3d& place) const override
    {
        return bounds_.contains(place) && side_(to_cgal(place)) != CGAL::ON_UNBOUNDED_SIDE;
    }
    bool meets(const Vector3d& from, const Vector3d& to) const override
    {
        return contains(from) ||
               (from != to && tree_.do_intersect(Kernel::Segment_3(to_cgal(from), to_cgal(to))));
    }
    Eigen::AlignedBox3d bounds() const override { return bounds_; }

  private:
    Triangles triangles_;
    Side::AABB_tree tree_;
    Side side_;
    Eigen::AlignedBox3d bounds_;
};

/// Makes one vertex of those at one place.
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
    }
    return std::make_unique<MeshRegion>(surface);
}

} // namespace vcarve
