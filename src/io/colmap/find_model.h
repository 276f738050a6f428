#pragma once

#include "io/colmap/colmap_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// The source of the points of a model.
enum class PointsFile {
    of_model, ///< its points3D.bin or .txt, or points3D.ply if there is neither
    another,  ///< another file, so cameras and images are enough
};

/// A model on disk, and notes for the user about how it was selected.
struct FoundModel {
    std::filesystem::path folder; ///< or the file transforms.json
    ModelFormat format = ModelFormat::binary;
    std::vector<std::string> notes; ///< sentences about ignored components, ignored .txt files, ...
};

/// The number of points of a model: the count in points3D.bin, or the number of records in
/// points3D.txt. Zero if the file is missing. Also zero if points3D.bin is too short for its count,
/// with the error message in `fault` unless it is null.
std::uint64_t count_points(const std::filesystem::path& folder, ModelFormat format,
                           std::string* fault = nullptr);

/// Finds the model for `input`: a model's folder or a file in it, a `sparse` folder with
/// components, a workspace with `sparse/0` or `sparse`, or a folder with models up to four levels
/// down. Selects the component with most points, and .bin if a folder has both formats. Throws
/// InputError if there is no model; the message lists the names searched for and the files found.
FoundModel find_model(const std::filesystem::path& input, PointsFile points = PointsFile::of_model);

} // namespace vcarve
