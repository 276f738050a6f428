#pragma once

#include "model/similarity.h"

#include <filesystem>
#include <string>

namespace vcarve {

/// Reads a transformation between frames from text, told by how many numbers it holds: 8 as
/// COLMAP's model_aligner writes them (scale, rotation as quaternion w x y z, translation), or 12
/// or 16, a matrix row by row as its releases up to 3.8 and CloudCompare do, whose last row is
/// 0 0 0 1. Lines that begin with # are comments. Throws InputError where the file is missing,
/// holds something else, or what it tells is no similarity.
Similarity read_sim3(const std::filesystem::path& file);

/// As COLMAP writes it: scale, quaternion, translation, with all digits.
std::string sim3_text(const Similarity& similarity);

} // namespace vcarve
