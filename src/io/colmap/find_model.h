#pragma once

#include "io/colmap/colmap_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// Where the points of a model are to come from.
enum class PointsFile {
    of_model, ///< from its points3D, .bin or .txt, or points3D.ply where there is neither
    another,  ///< from elsewhere: cameras and images are enough
};

/// A model on disk, and what the user should know about how it was chosen.
struct FoundModel {
    std::filesystem::path folder; ///< or the file transforms.json
    ModelFormat format = ModelFormat::binary;
    std::vector<std::string> notes; ///< sentences: components not taken, .txt files ignored, ...
};

/// How many points a model has: what the header of points3D.bin says, or zero where the file cannot
/// hold that many, which `fault` says as a sentence if it is not null; as many as points3D.txt has
/// lines; zero where there is neither.
std::uint64_t count_points(const std::filesystem::path& folder, ModelFormat format,
                           std::string* fault = nullptr);

/// Finds the model that `input` means: the model's own folder or a file in it, a `sparse` folder
/// with components (the one with most points is taken), a workspace that holds `sparse/0` or
/// `sparse`, or a folder with models up to four levels down. Where a folder has both formats, .bin
/// is taken. Throws InputError where there is none, saying what was looked for and what is there.
FoundModel find_model(const std::filesystem::path& input, PointsFile points = PointsFile::of_model);

} // namespace vcarve
