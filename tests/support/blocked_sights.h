#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <set>
#include <utility>
#include <vector>

namespace vcarve::testing {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Whether a segment meets a triangle, its border included; exact. Not for segments in its plane.
bool meets(const Triangle& triangle, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The corners of every face.
std::vector<Triangle> triangles_of(const TriMesh& mesh);

/// Where the sight of a point to a view begins if so much next to the point does not count.
Eigen::Vector3d trimmed(const Scene& scene, std::uint32_t point, std::uint32_t view, double margin);

/// The sights, as pairs of point and view, that some face meets, found by trying all. What lies
/// within the margin of its point does not count.
std::set<std::pair<std::uint32_t, std::uint32_t>>
blocked_sights(const Scene& scene, const TriMesh& mesh, const std::vector<double>& margins);

/// Per vertex the median length of the edges of its faces, each face counting its own.
std::vector<double> spacings_of(const TriMesh& mesh);

/// Per point the spacing of its vertex in `mesh`, the least if it has several, 0 if it has none.
std::vector<double> margins_in(const TriMesh& mesh, const Scene& scene);

/// n x n vertices on the unit square, at height 0, each at a point of its own (in that order).
TriMesh flat_grid(std::uint32_t n);

/// No views and no points: a guard that guards nothing.
Scene empty_scene();

} // namespace vcarve::testing
