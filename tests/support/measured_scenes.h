#pragma once

#include "compare/reference.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace vcarve::testing {

/// The square [0, 1] x [0, 1] at height z, facing up.
TriMesh square(double z = 0.0);
/// The rectangle [x0, x1] x [0, 1] at height z, facing up.
TriMesh strip(double x0, double x1, double z);
/// The unit cube, closed and oriented outward.
TriMesh cube();
/// A torus of n x n quads, closed and oriented outward.
TriMesh torus(std::uint32_t n);
/// Both in one mesh.
TriMesh together(const TriMesh& a, const TriMesh& b);
TriMesh moved(TriMesh mesh, const Eigen::Vector3d& shift);
TriMesh scaled(TriMesh mesh, double factor);
/// Reverses every face.
TriMesh flipped(TriMesh mesh);
/// Random triangles with corners in the unit cube.
TriMesh random_soup(std::size_t faces, std::uint64_t seed);

/// The distance from a position to the nearest point of a face.
double distance_to_face(const TriMesh& mesh, const Face& face, const Eigen::Vector3d& x);

/// The result of TriangleTree::first_hit, computed by trying every face. Exact if nothing is
/// degenerate.
std::optional<FirstHit> first_hit_of_all(const TriMesh& mesh, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& towards);

/// A grid of n x n points on the square at height 0, all seen from `centers`. The cameras look down
/// and show everything in front of them.
Scene scene_above_square(std::size_t n, const std::vector<Eigen::Vector3d>& centers);
/// A pinhole camera without distortion. Its axis passes through the center of a square image that
/// reaches `tangent` to each side at distance 1.
Camera square_camera(std::uint64_t size_px, double tangent);
/// Four views high above the square.
std::vector<Eigen::Vector3d> high_centers();

/// Few samples, for fast tests.
CompareOptions few_samples();

} // namespace vcarve::testing
