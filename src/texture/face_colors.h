#pragma once

#include "base/progress.h"
#include "texture/calibrated_photo.h"
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

/// The colours a photograph shows of a face: at its three corners and over its middle.
using ColorsOfFace = std::array<Color, 4>;

/// Parallel to the faces, and within each to the photographs that show it.
using FaceColors = std::vector<std::array<ColorsOfFace, PhotosOfFace::kMost>>;

/// Of each photograph, by how much each of its channels is to be multiplied so that photographs
/// agree with one another.
using Gains = std::vector<Eigen::Array3f>;

/// Calls body(photo, pyramid) for all photographs, with at most `at_a_time` of them in memory. An
/// unreadable photograph shows nothing. Returns a sentence for each unreadable photograph.
std::vector<std::string>
for_each_photograph(const std::vector<CalibratedPhoto>& photos, std::size_t at_a_time,
                    const Progress& progress,
                    const std::function<void(std::uint32_t, const PhotoPyramid&)>& body);

/// What photographs show of the faces.
struct ShownColors {
    FaceColors colors;
    std::vector<std::string> unreadable; ///< a sentence for each photograph
};

/// Looks up the colors of the faces. A photograph that is transparent where it should show a face
/// is taken from that face's photographs. Reads each photograph once.
ShownColors look_up_colors(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                           std::vector<PhotosOfFace>& photos_of_faces, std::size_t at_a_time,
                           const Progress& progress);

/// The exposures of photographs, as the faces tell that several show: each gain is the median
/// quotient of what others and what the photograph shows, in some rounds; their mean is 1.
Gains find_gains(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces,
                 const FaceColors& colors);

/// Takes out photographs that show something else where a face is, as somebody who passes by: those
/// that differ much more from the median of all than the others do (after M. Waechter, N. Moehrle
/// and M. Goesele, "Let there be color! Large-scale texturing of 3D reconstructions", ECCV 2014).
/// Of two nobody knows which is right. Returns how many were taken out.
std::size_t drop_outliers(const Gains& gains, std::vector<PhotosOfFace>& photos_of_faces,
                          FaceColors& colors);

} // namespace vcarve
