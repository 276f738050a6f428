#pragma once

#include "base/progress.h"
#include "texture/calibrated_photo.h"
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
    float area_px2 = 0.0F; ///< that the face takes of the photograph
};

/// The photographs that show all of a face, unhidden, those that show it largest first.
struct PhotosOfFace {
    static constexpr int kMost = 10;

    std::array<PhotoOfFace, kMost> best;
    std::uint8_t count = 0;
    bool is_partly_shown = false; ///< none shows all of it, but one a part

    std::span<const PhotoOfFace> shown() const { return {best.data(), count}; }
};

/// A face that a photograph shows.
struct FaceOfPhoto {
    std::uint32_t face = 0;
    std::uint32_t place = 0; ///< of the photograph among those that show the face
};

/// Of each photograph the faces it shows, ascending. Cost: O(faces).
std::vector<std::vector<FaceOfPhoto>>
faces_of_photos(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces);

/// The pixels of a face's corners; nothing where one of them is not shown, or where the photograph
/// bends the face so much that its corners do not tell where it lies (at the seam of a panorama).
std::optional<std::array<Eigen::Vector2d, 3>>
corner_pixels(const CalibratedPhoto& photo, const std::array<Eigen::Vector3d, 3>& corners);

/// Of each face the photographs that show it. A face counts as shown where seven places of it are:
/// near its corners, amid its edges and in its middle, and where it is seen at 6 degrees or more.
/// Photographs with a depth discontinuity within 3 pixels of the face count only if all have one.
/// Where no photograph shows all of a face, but one a part, the face is halved at its longest edge
/// until its parts are shown or not, or are some pixels long; so is a face longer than an eighth of
/// the photograph that shows it best. Faces beside are halved with it, so the surface stays whole.
/// Cost: O(faces x photographs) for what lies before the cameras, and some hundred rays a face
/// through Embree's tree.
std::vector<PhotosOfFace> find_photos_of_faces(TriMesh& mesh,
                                               const std::vector<CalibratedPhoto>& photos,
                                               const Progress& progress);

} // namespace vcarve
