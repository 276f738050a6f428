#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace vcarve {

/// The colors of a face in a photograph: at its three corners and around its centroid.
using ColorsOfFace = std::array<Color, 4>;

/// One entry per face, and within it one per photograph that shows the face.
using FaceColors = std::vector<std::array<ColorsOfFace, PhotosOfFace::kMost>>;

/// Factors for the channels of each photograph that make the exposures of photographs agree.
using Gains = std::vector<Eigen::Array3f>;

/// Calls body(photo, pyramid) for all photographs, with at most `at_a_time` of them in memory. An
/// unreadable photograph shows nothing. Returns a sentence for each unreadable photograph.
std::vector<std::string>
for_each_photograph(const std::vector<CalibratedPhoto>& photos, std::size_t at_a_time,
                    const Progress& progress,
                    const std::function<void(std::uint32_t, const PhotoPyramid&)>& body);

/// The colors of faces in their photographs.
struct ShownColors {
    FaceColors colors;
    std::vector<std::string> unreadable; ///< a sentence for each photograph
};

/// Looks up the colors of the faces. Removes a photograph from the list of a face if it is
/// transparent there. Reads each photograph once.
ShownColors look_up_colors(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                           std::vector<PhotosOfFace>& photos_of_faces, std::size_t at_a_time,
                           const Progress& progress);

/// Estimates gains from faces with several photographs. A gain is the median ratio of the colors in
/// other photographs to the colors in this one, iterated. The mean gain is 1.
Gains find_gains(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces,
                 const FaceColors& colors);

/// Drops photographs that show a transient occluder, such as a passer-by, instead of a face: they
/// differ much more from the median of all than the others do (after M. Waechter, N. Moehrle and M.
/// Goesele, "Let there be color! Large-scale texturing of 3D reconstructions", ECCV 2014). Keeps
/// both of two photographs, because either may be right. Returns the number of drops.
std::size_t drop_outliers(const Gains& gains, std::vector<PhotosOfFace>& photos_of_faces,
                          FaceColors& colors);

} // namespace vcarve
