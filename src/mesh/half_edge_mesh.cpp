#include "mesh/half_edge_mesh.h"

#include "base/parallel.h"
#include "base/statistics.h"

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Numbers the edges of a surface by their first half-edges, as add_face() does. OpenMesh's
/// half-edge 2 e is the first half-edge of edge e, and 2 e + 1 the opposite one.
class EdgeNumbers {
  public:
    explicit EdgeNumbers(std::span<const HalfEdge> twins)
        : twins_(twins),
          first_half_edges_(parallel_collect<HalfEdge>(
              twins.size(),
              [&](std::size_t i, auto& firsts) {
                  const HalfEdge half_edge = static_cast<HalfEdge>(i);
                  if (half_edge < twins[half_edge])
                      firsts.push_back(half_edge); // kNoHalfEdge is the greatest
              })),
          numbers_(twins.size())
    {
        parallel_for(first_half_edges_.size(), [&](std::size_t edge) {
            const HalfEdge half_edge = first_half_edges_[edge];
            numbers_[half_edge] = static_cast<std::uint32_t>(2 * edge);
            if (twins[half_edge] != kNoHalfEdge)
                numbers_[twins[half_edge]] = numbers_[half_edge] + 1;
        });
    }

    const std::vector<HalfEdge>& first_half_edges() const { return first_half_edges_; }
    bool is_border(HalfEdge half_edge) const { return twins_[half_edge] == kNoHalfEdge; }

    HalfedgeHandle along(HalfEdge half_edge) const
    {
        return handle_at<HalfedgeHandle>(numbers_[half_edge]);
    }
    /// The opposite half-edge, which has no face if `half_edge` is on the boundary.
    HalfedgeHandle against(HalfEdge half_edge) const
    {
        return handle_at<HalfedgeHandle>(numbers_[half_edge] ^ 1U);
    }

    /// The boundary half-edge whose opposite follows the opposite of `border` along the boundary.
    HalfEdge next_border(HalfEdge border) const
    {
        HalfEdge half_edge = previous_half_edge(border);
        while (!is_border(half_edge)) {
            half_edge = previous_half_edge(twins_[half_edge]);
        }
        return half_edge;
    }

  private:
    std::span<const HalfEdge> twins_;
    std::vector<HalfEdge> first_half_edges_; ///< one per edge
    std::vector<std::uint32_t> numbers_;     ///< OpenMesh's number of each half-edge
};

void connect_faces(const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    parallel_for(mesh.n_faces(), [&](std::size_t f) {
        const auto face = handle_at<FaceHandle>(f);
        const HalfEdge first = static_cast<HalfEdge>(3 * f);
        for (HalfEdge half_edge = first; half_edge < first + 3; ++half_edge) {
            mesh.set_face_handle(edges.along(half_edge), face);
            mesh.set_next_halfedge_handle(edges.along(half_edge),
                                          edges.along(next_half_edge(half_edge)));
        }
        mesh.set_halfedge_handle(face, edges.along(first + 2)); // the half-edge to the first corner
    });
}

/// Sets the vertices of edges, and the next half-edges along the boundary.
void connect_edges(const std::vector<Face>& faces, const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    parallel_for(edges.first_half_edges().size(), [&](std::size_t edge) {
        const HalfEdge half_edge = edges.first_half_edges()[edge];
        mesh.set_vertex_handle(edges.along(half_edge),
                               handle_at<VertexHandle>(head(faces, half_edge)));
        mesh.set_vertex_handle(edges.against(half_edge),
                               handle_at<VertexHandle>(tail(faces, half_edge)));
        if (!edges.is_border(half_edge)) return;
        mesh.set_next_halfedge_handle(edges.against(half_edge),
                                      edges.against(edges.next_border(half_edge)));
    });
}

/// Gives each vertex its last outgoing half-edge, or the boundary half-edge, as OpenMesh requires.
/// Sequential, so that the result is deterministic.
void connect_vertices(const std::vector<Face>& faces, const EdgeNumbers& edges, HalfEdgeMesh& mesh)
{
    for (HalfEdge half_edge = 0; half_edge < 3 * faces.size(); ++half_edge) {
        mesh.set_halfedge_handle(handle_at<VertexHandle>(tail(faces, half_edge)),
                                 edges.along(half_edge));
    }
    for (const HalfEdge half_edge : edges.first_half_edges()) {
        if (!edges.is_border(half_edge)) continue;
        mesh.set_halfedge_handle(handle_at<VertexHandle>(head(faces, half_edge)),
                                 edges.against(half_edge));
    }
}

} // namespace

HalfEdgeMesh::HalfEdgeMesh(const TriMesh& mesh, std::span<const HalfEdge> twins)
    : offset_(mesh.offset),
      has_colors_(!mesh.colors.empty()),
      has_scene_points_(!mesh.points.empty())
{
    const EdgeNumbers edges(twins);
    resize(mesh.positions.size(), edges.first_half_edges().size(), mesh.faces.size());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        const auto vertex = handle_at<VertexHandle>(v);
        set_point(vertex, mesh.positions[v]);
        set_normal(vertex, Vector3d::Zero());
        if (has_colors_) data(vertex).color = mesh.colors[v];
        if (has_scene_points_) data(vertex).scene_point = mesh.points[v];
    });
    connect_edges(mesh.faces, edges, *this);
    connect_faces(edges, *this);
    connect_vertices(mesh.faces, edges, *this);
}

std::array<VertexHandle, 3> HalfEdgeMesh::corners(FaceHandle face) const
{
    const HalfedgeHandle last = halfedge_handle(face);
    const HalfedgeHandle first = next_halfedge_handle(last);
    return {to_vertex_handle(last), to_vertex_handle(first),
            to_vertex_handle(next_halfedge_handle(first))};
}

std::array<Vector3d, 3> HalfEdgeMesh::triangle(FaceHandle face) const
{
    const auto [a, b, c] = corners(face);
    return {point(a), point(b), point(c)};
}

std::int64_t num_vertices_left(const HalfEdgeMesh& mesh)
{
    return parallel_sum(mesh.n_vertices(), std::int64_t{0}, [&](std::size_t v) {
        return mesh.is_deleted(handle_at<VertexHandle>(v)) ? 0 : 1;
    });
}

std::int64_t num_faces_left(const HalfEdgeMesh& mesh)
{
    return parallel_sum(mesh.n_faces(), std::int64_t{0}, [&](std::size_t f) {
        return mesh.is_deleted(handle_at<FaceHandle>(f)) ? 0 : 1;
    });
}

std::int64_t num_boundary_edges(const HalfEdgeMesh& mesh)
{
    return parallel_sum(mesh.n_faces(), std::int64_t{0}, [&](std::size_t f) {
        const auto face = handle_at<FaceHandle>(f);
        std::int64_t of_face = 0;
        if (mesh.is_deleted(face)) return of_face;
        for (const auto half_edge : mesh.fh_range(face)) {
            of_face += half_edge.opp().is_boundary() ? 1 : 0;
        }
        return of_face;
    });
}

TriMesh tri_mesh(const HalfEdgeMesh& mesh)
{
    const auto vertices =
        parallel_collect<VertexHandle>(mesh.n_vertices(), [&](std::size_t v, auto& kept) {
            const auto vertex = handle_at<VertexHandle>(v);
            if (!mesh.is_deleted(vertex)) kept.push_back(vertex);
        });
    TriMesh result;
    result.offset = mesh.offset();
    result.positions.resize(vertices.size());
    result.normals.resize(vertices.size());
    if (mesh.has_colors()) result.colors.resize(vertices.size());
    if (mesh.has_scene_points()) result.points.resize(vertices.size());
    std::vector<std::uint32_t> numbers(mesh.n_vertices());
    parallel_for(vertices.size(), [&](std::size_t i) {
        numbers[index(vertices[i])] = static_cast<std::uint32_t>(i);
        result.positions[i] = mesh.point(vertices[i]);
        result.normals[i] = mesh.normal(vertices[i]).cast<float>();
        if (mesh.has_colors()) result.colors[i] = mesh.data(vertices[i]).color;
        if (mesh.has_scene_points()) result.points[i] = mesh.data(vertices[i]).scene_point;
    });
    result.faces = parallel_collect<Face>(mesh.n_faces(), [&](std::size_t f, auto& faces) {
        const auto face = handle_at<FaceHandle>(f);
        if (mesh.is_deleted(face)) return;
        const auto [a, b, c] = mesh.corners(face);
        faces.push_back({numbers[index(a)], numbers[index(b)], numbers[index(c)]});
    });
    return result;
}

Vector3d vertex_normal(const HalfEdgeMesh& mesh, VertexHandle vertex)
{
    // OpenMesh's calc_vertex_normal() gives all faces equal weight, and ..._correct() counts the
    // gap at a boundary as a face.
    Vector3d sum = Vector3d::Zero();
    for (const auto incoming : mesh.vih_range(vertex)) {
        if (mesh.is_boundary(incoming)) continue;
        Vector3d twice_area;
        mesh.calc_sector_normal(incoming, twice_area);
        sum += twice_area;
    }
    return sum.normalized(); // zero stays zero
}

void set_vertex_normals(HalfEdgeMesh& mesh)
{
    parallel_for(mesh.n_vertices(), [&](std::size_t v) {
        const auto vertex = handle_at<VertexHandle>(v);
        if (mesh.is_deleted(vertex)) return;
        mesh.set_normal(vertex, vertex_normal(mesh, vertex));
    });
}

std::vector<double> vertex_spacings(const HalfEdgeMesh& mesh)
{
    std::vector<double> spacings(mesh.n_vertices(), 0.0);
    parallel_for_with_list<double>(spacings.size(), [&](std::size_t v, auto& lengths) {
        for (const auto edge : mesh.ve_range(handle_at<VertexHandle>(v))) {
            const double length = mesh.calc_edge_length(edge);
            lengths.push_back(length);
            if (!mesh.is_boundary(edge)) lengths.push_back(length); // count it for each face
        }
        spacings[v] = median_in_place(lengths);
    });
    return spacings;
}

} // namespace vcarve
