#pragma once

#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The part of a ray that may meet the surface.
struct ViewLine {
    Eigen::Vector3d eye;
    Eigen::Vector3d end;
};

/// The open share of the visible surface.
struct Openness {
    std::int64_t rays = 0;      ///< number of rays that were followed
    std::int64_t past = 0;      ///< number that miss the boundary: sky, or surfaces without points
    std::vector<ViewLine> open; ///< rays that meet the boundary, but no kept face
};

/// Follows about 4,000 rays through the centers of a grid of cells in every image. Of more than 512
/// views, 512 evenly spread ones are used. Views without points and unknown lenses are skipped.
/// `facets` are the boundary of the labels, and `keep` flags the kept ones. Cost: a walk to each
/// view and along each ray, in parallel; O(rays) to find a point of each view.
Openness measure_openness(const TetMesh& cells, const Labels& labels,
                          const std::vector<CellFacet>& facets, const FaceFlags& keep,
                          const Scene& scene);

/// The number of lines that meet no triangle, exact. Triangles without area are ignored. Cost:
/// O((lines + triangles) log triangles), mostly in parallel.
std::int64_t count_free(const std::vector<ViewLine>& lines,
                        const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);

} // namespace vcarve
