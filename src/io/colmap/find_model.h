#pragma once

#include "io/colmap/colmap_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// A model on disk, and what the user should know about how it was chosen.
struct FoundModel {
    std::filesystem::path folder;
    ModelFormat format = ModelFormat::binary;
    std::vector<std::string> notes; ///< sentences: components not taken, .txt files ignored, ...
};

/// Finds the model that `input` means: the model's own folder, a `sparse` folder with components
/// (the one with most points is taken), or a workspace that holds `sparse/0` or `sparse`. Where a
/// folder has both formats, .bin is taken. Throws InputError where there is none, saying what was
/// looked for and what is there.
FoundModel find_model(const std::filesystem::path& input);

} // namespace vcarve
