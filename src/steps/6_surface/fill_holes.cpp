#include "steps/6_surface/fill_holes.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Twice the area of the faces along a loop, as the sum of normal vectors and as a total.
struct AreaAlong {
    Vector3d sum = Vector3d::Zero();
    double total = 0.0;
};

AreaAlong area_along(const HalfEdgeMesh& mesh, const BoundaryLoop& loop)
{
    AreaAlong area;
    for (const HalfedgeHandle edge : loop) {
        Vector3d twice_area;
        mesh.calc_sector_normal(mesh.opposite_halfedge_handle(edge), twice_area);
        area.sum += twice_area;
        area.total += twice_area.norm();
    }
    return area;
}

/// Twice the area vector of any surface that fills the loop, which depends only on the loop.
Vector3d area_within(const HalfEdgeMesh& mesh, const BoundaryLoop& loop)
{
    const Vector3d& origin = mesh.point(mesh.from_vertex_handle(loop[0]));
    Vector3d area = Vector3d::Zero();
    for (const HalfedgeHandle edge : loop) {
        area += (mesh.point(mesh.from_vertex_handle(edge)) - origin)
                    .cross(mesh.point(mesh.to_vertex_handle(edge)) - origin);
    }
    return area;
}

/// The least-area triangulation of a polygon in space, by dynamic programming over its chords.
/// CGAL's triangulate_hole() minimizes angles first, so its patches bulge.
class PolygonFill {
  public:
    PolygonFill(const HalfEdgeMesh& mesh, std::vector<VertexHandle> corners)
        : mesh_(mesh), corners_(std::move(corners)), chords_(corners_.size() * corners_.size())
    {
        const std::size_t n = corners_.size();
        for (std::size_t span = 2; span < n; ++span) {
            for (std::size_t i = 0; i + span < n; ++i) {
                fill_behind(i, i + span);
            }
        }
    }

    bool exists() const { return std::isfinite(chord(0, corners_.size() - 1).area); }

    /// Adds the triangles. Requires exists().
    void add_to(HalfEdgeMesh& mesh) const { add_behind(mesh, 0, corners_.size() - 1); }

  private:
    /// A chord from corner i to corner j: the least area of the polygon i, i + 1, ..., j, and the
    /// third corner of the triangle at the chord.
    struct Chord {
        double area = 0.0;
        std::size_t apex = 0;
    };

    Chord& chord(std::size_t i, std::size_t j) { return chords_[i * corners_.size() + j]; }
    const Chord& chord(std::size_t i, std::size_t j) const
    {
        return chords_[i * corners_.size() + j];
    }

    double triangle_area(std::size_t i, std::size_t k, std::size_t j) const
    {
        const Vector3d& a = mesh_.point(corners_[i]);
        return (mesh_.point(corners_[k]) - a).cross(mesh_.point(corners_[j]) - a).norm() / 2;
    }

    void fill_behind(std::size_t i, std::size_t j)
    {
        Chord& best = chord(i, j);
        best.area = std::numeric_limits<double>::infinity(); // impossible
        const bool closes_loop = i == 0 && j + 1 == corners_.size();
        const bool taken = mesh_.find_halfedge(corners_[i], corners_[j]).is_valid();
        if (taken && !closes_loop) return;
        for (std::size_t k = i + 1; k < j; ++k) {
            const double area = chord(i, k).area + chord(k, j).area + triangle_area(i, k, j);
            if (area < best.area) best = {area, k};
        }
    }

    void add_behind(HalfEdgeMesh& mesh, std::size_t i, std::size_t j) const
    {
        if (j - i < 2) return;
        const std::size_t k = chord(i, j).apex;
        mesh.add_face(corners_[i], corners_[k], corners_[j]);
        add_behind(mesh, i, k);
        add_behind(mesh, k, j);
    }

    const HalfEdgeMesh& mesh_;
    std::vector<VertexHandle> corners_;
    std::vector<Chord> chords_;
};

VertexHandle add_middle(HalfEdgeMesh& mesh, const std::vector<VertexHandle>& corners)
{
    const auto count = static_cast<double>(corners.size());
    Vector3d position = Vector3d::Zero();
    Vector3d color = Vector3d::Constant(0.5); // rounds to nearest
    for (const VertexHandle corner : corners) {
        const Color& c = mesh.data(corner).color;
        position += mesh.point(corner) / count;
        color += Vector3d(c[0], c[1], c[2]) / count;
    }
    // NOLINTNEXTLINE(cppcoreguidelines-slicing): only the handle is needed
    const VertexHandle middle = mesh.add_vertex(position);
    mesh.data(middle).color = {static_cast<std::uint8_t>(color[0]),
                               static_cast<std::uint8_t>(color[1]),
                               static_cast<std::uint8_t>(color[2])};
    return middle;
}

void add_fan(HalfEdgeMesh& mesh, const std::vector<VertexHandle>& corners)
{
    const VertexHandle middle = add_middle(mesh, corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        mesh.add_face(corners[i], corners[(i + 1) % corners.size()], middle);
    }
}

/// The half-edges without a face whose opposite face is not deleted, ascending.
std::vector<HalfedgeHandle> boundary_half_edges(const HalfEdgeMesh& mesh)
{
    return parallel_collect<HalfedgeHandle>(mesh.n_halfedges(), [&](std::size_t h, auto& found) {
        const auto edge = handle_at<HalfedgeHandle>(h);
        if (!mesh.is_boundary(edge)) return;
        const FaceHandle beside = mesh.face_handle(mesh.opposite_halfedge_handle(edge));
        if (!mesh.is_deleted(beside)) found.push_back(edge);
    });
}

/// Whether a loop is short enough, not an outer boundary, and does not touch itself.
bool is_fillable(const HalfEdgeMesh& mesh, const BoundaryLoop& loop, int max_edges)
{
    return loop.size() <= static_cast<std::size_t>(std::max(max_edges, 0)) && !is_rim(mesh, loop) &&
           !touches_itself(mesh, loop);
}

} // namespace

std::vector<BoundaryLoop> boundary_loops(const HalfEdgeMesh& mesh)
{
    std::vector<char> seen(mesh.n_halfedges(), 0);
    std::vector<BoundaryLoop> loops;
    for (const HalfedgeHandle first : boundary_half_edges(mesh)) {
        if (seen[index(first)] != 0) continue;
        BoundaryLoop loop;
        for (HalfedgeHandle edge = first; seen[index(edge)] == 0;
             edge = mesh.next_halfedge_handle(edge)) {
            seen[index(edge)] = 1;
            loop.push_back(edge);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

bool is_rim(const HalfEdgeMesh& mesh, const BoundaryLoop& loop)
{
    constexpr double kCosine = -0.5;
    const AreaAlong along = area_along(mesh, loop);
    const Vector3d within = area_within(mesh, loop);
    return within.dot(along.sum) < kCosine * within.norm() * along.total;
}

bool touches_itself(const HalfEdgeMesh& mesh, const BoundaryLoop& loop)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (mesh.point(mesh.from_vertex_handle(loop[i])) ==
                mesh.point(mesh.from_vertex_handle(loop[j]))) {
                return true;
            }
        }
    }
    return false;
}

void fill_hole(HalfEdgeMesh& mesh, const BoundaryLoop& loop)
{
    std::vector<VertexHandle> corners;
    for (const HalfedgeHandle edge : loop) {
        corners.push_back(mesh.from_vertex_handle(edge));
    }
    const PolygonFill fill(mesh, corners);
    if (fill.exists()) {
        fill.add_to(mesh);
    } else {
        add_fan(mesh, corners);
    }
}

std::int64_t fill_holes(HalfEdgeMesh& mesh, int max_edges)
{
    const auto was_trimmed = [&](HalfedgeHandle edge) {
        return mesh.has_scene_points() &&
               mesh.data(mesh.from_vertex_handle(edge)).scene_point == kNoPoint;
    };
    std::int64_t num_filled = 0;
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
        if (!is_fillable(mesh, loop, max_edges) || std::ranges::any_of(loop, was_trimmed)) continue;
        fill_hole(mesh, loop);
        ++num_filled;
    }
    return num_filled;
}

} // namespace vcarve
