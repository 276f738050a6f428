#pragma once

#include "compare/reference.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace vcarve::testing {

/// The square [0, 1] x [0, 1] at height z, its front up.
TriMesh square(double z = 0.0);
/// [x0, x1] x [0, 1] at height z, its front up.
TriMesh strip(double x0, double x1, double z);
/// The unit cube, closed and oriented outward.
TriMesh cube();
/// A torus of n x n quads, closed and oriented outward.
TriMesh torus(std::uint32_t n);
/// Both, side by side in one mesh.
TriMesh together(const TriMesh& a, const TriMesh& b);
TriMesh moved(TriMesh mesh, const Eigen::Vector3d& shift);
TriMesh scaled(TriMesh mesh, double factor);
/// Every face turned over.
TriMesh flipped(TriMesh mesh);
/// Random triangles with corners in the unit cube.
TriMesh random_soup(std::size_t faces, std::uint64_t seed);

/// From a place to the nearest point of a face.
double distance_to_face(const TriMesh& mesh, const Face& face, const Eigen::Vector3d& x);

/// What TriangleTree::first_hit finds, by solving for every face; exact where nothing is
/// degenerate.
std::optional<FirstHit> first_hit_of_all(const TriMesh& mesh, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& towards);

/// n x n points on the square at height 0, a grid with a step of 1 / (n - 1), all seen from
/// `centers`. The cameras show everything before them and look down.
Scene scene_above_square(std::size_t n, const std::vector<Eigen::Vector3d>& centers);
/// A pinhole without distortion, its axis through the middle of a square image that shows `tangent`
/// to every side at a distance of 1.
Camera square_camera(std::uint64_t size_px, double tangent);
/// Four views high above the square.
std::vector<Eigen::Vector3d> high_centers();

/// Few samples, so that tests are quick.
CompareOptions few_samples();

} // namespace vcarve::testing
