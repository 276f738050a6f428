#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

/// How a photograph shows a face.
struct PhotoOfFace {
    std::uint32_t photo = 0;
    float area_px2 = 0.0F; ///< area of the face in the photograph
};

/// The photographs that show all of a face, unoccluded, in order of decreasing area.
struct PhotosOfFace {
    static constexpr int kMost = 10;

    std::array<PhotoOfFace, kMost> best;
    std::uint8_t count = 0;
    bool is_partly_shown = false; ///< a photograph shows a part, none shows all of it

    std::span<const PhotoOfFace> shown() const { return {best.data(), count}; }
};

/// A face that a photograph shows.
struct FaceOfPhoto {
    std::uint32_t face = 0;
    std::uint32_t place = 0; ///< index of the photograph in the list of the face
};

/// Returns the faces that each photograph shows, ascending. Cost: O(faces).
std::vector<std::vector<FaceOfPhoto>>
faces_of_photos(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces);

/// Returns the pixels of a face's corners. Returns nothing if a corner is not visible, or if the
/// photograph bends the face so much that the corners do not bound it (at a panorama's seam).
std::optional<std::array<Eigen::Vector2d, 3>>
corner_pixels(const CalibratedPhoto& photo, const std::array<Eigen::Vector3d, 3>& corners);

/// Finds the photographs of each face. A photograph shows a face if it sees it at 6 degrees or more
/// and sees seven positions: near the corners, near the edges' midpoints, and the centroid.
/// Photographs with a depth discontinuity within 3 pixels of the face count only if all have one.
/// Bisects a face at its longest edge if photographs show only a part of it, or if it is longer
/// than an eighth of the photograph that shows it largest. Parts shorter than 24 pixels are not
/// bisected for being partly visible. Neighbors are bisected, too, so the surface stays conforming.
/// Cost: O(faces x photographs) projections, and some hundred rays per face through Embree's tree.
std::vector<PhotosOfFace> find_photos_of_faces(TriMesh& mesh,
                                               const std::vector<CalibratedPhoto>& photos,
                                               const Progress& progress);

} // namespace vcarve
