#pragma once

#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// A line of sight, as far as it may meet anything.
struct ViewLine {
    Eigen::Vector3d eye;
    Eigen::Vector3d end;
};

/// How much of what the views look at is open.
struct Openness {
    std::int64_t rays = 0;      ///< lines of sight that were followed
    std::int64_t past = 0;      ///< that meet no boundary: to the sky, or where no points lie
    std::vector<ViewLine> open; ///< those that meet the boundary, but nothing of it that is kept
};

/// Follows the lines of sight through the middles of a grid of cells in every image, about 4,000 in
/// all. Of more than 512 views, that many, evenly spread. Views without points, and lenses that are
/// not known, have none. `facets` are the boundary of the labels, `keep` says which of them are
/// kept. Cost: a walk to each view and along each ray, in parallel; O(sights) to find a point of
/// each view.
Openness measure_openness(const TetMesh& cells, const Labels& labels,
                          const std::vector<CellFacet>& facets, const FaceFlags& keep,
                          const Scene& scene);

/// How many of some lines meet no triangle, exact; those without area are met by none. Cost:
/// O((lines + triangles) log triangles), mostly in parallel.
std::int64_t count_free(const std::vector<ViewLine>& lines,
                        const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);

} // namespace vcarve
