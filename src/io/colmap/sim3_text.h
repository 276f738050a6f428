#pragma once

#include "model/similarity.h"

#include <filesystem>
#include <string>

namespace vcarve {

/// Reads a transformation between frames from text. The count of numbers selects the format: 8 are
/// scale, rotation (quaternion w x y z) and translation, as COLMAP's model_aligner writes them. 12
/// or 16 are a matrix in row order, whose fourth row is 0 0 0 1, as COLMAP up to 3.8 and
/// CloudCompare write it. Lines that begin with # are comments. Throws InputError if the file is
/// missing, has another count of numbers, or is not a similarity.
Similarity read_sim3(const std::filesystem::path& file);

/// Formats a similarity as COLMAP does: scale, quaternion, translation, with all digits.
std::string sim3_text(const Similarity& similarity);

} // namespace vcarve
