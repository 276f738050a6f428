#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <set>
#include <utility>
#include <vector>

namespace vcarve::testing {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Whether a segment meets a triangle or its border; exact. Not for segments in the same plane.
bool meets(const Triangle& triangle, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The corners of every face.
std::vector<Triangle> triangles_of(const TriMesh& mesh);

/// The position on the ray from a point to a view at distance `margin` from the point.
Eigen::Vector3d trimmed(const Scene& scene, std::uint32_t point, std::uint32_t view, double margin);

/// The rays, as pairs of point and view, that a face meets; tries all. The part of a ray within the
/// margin of its point is ignored.
std::set<std::pair<std::uint32_t, std::uint32_t>>
blocked_rays(const Scene& scene, const TriMesh& mesh, const std::vector<double>& margins);

/// The median edge length around each vertex; an edge counts once per face.
std::vector<double> spacings_of(const TriMesh& mesh);

/// The spacing of each point's vertex in `mesh`: the least of several, 0 without a vertex.
std::vector<double> margins_in(const TriMesh& mesh, const Scene& scene);

/// n x n vertices on the unit square at height 0; vertex i belongs to point i.
TriMesh flat_grid(std::uint32_t n);

/// No views and no points, so that no ray restricts a change.
Scene empty_scene();

} // namespace vcarve::testing
