#pragma once

#include "model/photograph.h"
#include "vcarve/log.h"
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
    std::vector<std::filesystem::path> masks;   ///< empty if none are used, or where there is none
    std::size_t missing = 0;                    ///< views without a file
    std::vector<std::string> unusable;          ///< a sentence for each file that cannot be used
};

/// Finds them as `folder`/name. A backslash in a name may separate folders, and a name may begin
/// with `images` or the name of `folder` itself. A view without such a file gets one whose name
/// differs in case or in its end only: a.png may be A.JPG. Names that lead out of the folder count
/// as missing. Files with another aspect ratio than their camera cannot be used. Reads the header
/// of each, on all threads. Throws InputError if there is no such folder, or no photograph that can
/// be used.
Photographs find_photographs(const Scene& scene, const std::filesystem::path& folder);

/// Finds the masks of the views in the same way, as `folder`/NAME.png, where NAME is that of the
/// photograph with its extension, as COLMAP does, or without. Throws as find_photographs().
Photographs find_masks(const Scene& scene, const std::filesystem::path& folder);

/// Adds one note about photographs that are left out. Each sentence begins with a path and a colon.
void note_unusable(const std::vector<std::string>& sentences, Log& log);

/// The folder that the names of a model's photographs are relative to: that of transforms.json, or
/// the folder `images` in the model's folder, beside the folder `sparse` that it is, or beside the
/// one that it is a part of (sparse/0). Nothing if there is none.
std::optional<std::filesystem::path> photographs_beside(const std::filesystem::path& model);

} // namespace vcarve
