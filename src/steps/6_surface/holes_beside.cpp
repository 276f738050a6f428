#include "steps/6_surface/holes_beside.h"

#include "mesh/used_vertices.h"
#include "steps/6_surface/fill_holes.h"
#include "steps/6_surface/split_nonmanifold.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace vcarve {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// The kept faces of a surface by their vertices, and the edges with one of them: its rims.
class Rims {
  public:
    Rims(const TriMesh& surface, const FaceFlags& keep)
        : surface_(surface), faces_at_(surface.faces, surface.positions.size(), keep)
    {
    }

    bool is_rim(std::uint32_t a, std::uint32_t b) const
    {
        return std::ranges::count_if(faces_at_[a], [&](std::uint32_t face) {
                   return std::ranges::count(surface_.faces[face], b) > 0;
               }) == 1;
    }

    /// The vertices up to so many edges along rims away from those of some faces.
    std::set<std::uint32_t> vertices_near(const std::vector<std::uint32_t>& some, int edges) const
    {
        std::set<std::uint32_t> found;
        std::set<std::uint32_t> last;
        for (const std::uint32_t face : some) {
            const Face& corners = surface_.faces[face];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = corners[i];
                const std::uint32_t b = corners[(i + 1) % 3];
                if (is_rim(a, b)) last.insert({a, b});
            }
        }
        for (int step = 0; step < edges && !last.empty(); ++step) {
            std::set<std::uint32_t> next;
            for (const std::uint32_t vertex : last) {
                found.insert(vertex);
                for (const std::uint32_t other : next_along_rims(vertex)) {
                    if (!found.contains(other) && !last.contains(other)) next.insert(other);
                }
            }
            last = std::move(next);
        }
        return found;
    }

    /// The kept faces at some vertices, ascending.
    std::vector<std::uint32_t> faces_around(const std::set<std::uint32_t>& vertices) const
    {
        std::set<std::uint32_t> faces;
        for (const std::uint32_t vertex : vertices) {
            faces.insert(faces_at_[vertex].begin(), faces_at_[vertex].end());
        }
        return {faces.begin(), faces.end()};
    }

  private:
    std::set<std::uint32_t> next_along_rims(std::uint32_t vertex) const
    {
        std::set<std::uint32_t> found;
        for (const std::uint32_t face : faces_at_[vertex]) {
            for (const std::uint32_t other : surface_.faces[face]) {
                if (other != vertex && is_rim(vertex, other)) found.insert(other);
            }
        }
        return found;
    }

    const TriMesh& surface_;
    VertexFaces faces_at_;
};

/// Some faces of a surface as one of their own, whose points are the vertices of that.
TriMesh part_of(const TriMesh& surface, const std::vector<std::uint32_t>& faces)
{
    TriMesh part;
    for (const std::uint32_t face : faces) {
        part.faces.push_back(surface.faces[face]);
    }
    part.points = used_vertices(part.faces, surface.positions.size());
    renumber(part.faces, part.points, surface.positions.size());
    for (const std::uint32_t vertex : part.points) {
        part.positions.push_back(surface.positions[vertex]);
    }
    return part;
}

} // namespace

void fill_holes_beside(const std::vector<std::uint32_t>& some, int max_edges, TriMesh& surface,
                       FaceFlags& keep)
{
    const Rims rims(surface, keep);
    const std::set<std::uint32_t> near = rims.vertices_near(some, max_edges);
    const std::vector<std::uint32_t> around = rims.faces_around(near);
    if (around.empty()) return;
    const ManifoldSurface manifold = split_nonmanifold(part_of(surface, around));
    HalfEdgeMesh mesh(manifold.mesh, manifold.twins);
    const auto vertex_of = [&](VertexHandle vertex) { return mesh.data(vertex).scene_point; };
    const auto is_beside = [&](HalfedgeHandle edge) {
        const std::size_t face = index(mesh.face_handle(mesh.opposite_halfedge_handle(edge)));
        return face < around.size() && std::ranges::binary_search(some, around[face]);
    };
    // Other loops are where the part ends, or go on beyond.
    const auto is_whole = [&](const BoundaryLoop& loop) {
        return std::ranges::all_of(loop, [&](HalfedgeHandle edge) {
            return near.contains(vertex_of(mesh.from_vertex_handle(edge)));
        });
    };
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
        if (!is_fillable(mesh, loop, max_edges) || !is_whole(loop) ||
            !std::ranges::any_of(loop, is_beside))
            continue;
        const std::size_t first = mesh.n_faces();
        const std::size_t first_vertex = mesh.n_vertices();
        fill_hole(mesh, loop);
        if (mesh.n_vertices() != first_vertex) continue; // a fan: rare, and left to be filled later
        for (std::size_t i = first; i < mesh.n_faces(); ++i) {
            Face face{};
            auto corner = face.begin();
            for (const VertexHandle vertex : mesh.fv_range(handle_at<FaceHandle>(i))) {
                *corner++ = vertex_of(vertex);
            }
            surface.faces.push_back(face);
            keep.push_back(1);
        }
    }
}

} // namespace vcarve
