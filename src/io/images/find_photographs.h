#pragma once

#include "model/photograph.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The photographs of the views of a scene. The arrays run parallel to the views.
struct Photographs {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> of_view; ///< empty where there is none that can be read
    std::vector<PhotographSize> sizes;          ///< zero where there is none
    std::size_t missing = 0;                    ///< views without a file
    std::vector<std::string> unreadable;        ///< a sentence for each file that is none
};

/// Finds them as `folder`/name; where not one is there, by names that end otherwise, as after the
/// photographs were converted: a.png may be a.JPG. Names that lead out of the folder count as
/// missing. Reads the header of each, on all threads. Throws InputError where there is no such
/// folder, or not one photograph that can be read.
Photographs find_photographs(const Scene& scene, const std::filesystem::path& folder);

/// The folder `images` that belongs to a model: in the model's folder, beside the folder `sparse`
/// that it is, or beside the one that it is a part of (sparse/0). Nothing where there is none.
std::optional<std::filesystem::path> photographs_beside(const std::filesystem::path& model);

} // namespace vcarve
