#pragma once

#include "model/photograph.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The photographs of the views of a scene. The first three arrays are parallel to the views.
struct Photographs {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> of_view; ///< empty if no file can be used
    std::vector<PhotographSize> sizes;          ///< zero if no file can be used
    std::vector<std::filesystem::path> masks;   ///< empty array if unused, empty path if missing
    std::size_t missing = 0;                    ///< views without a file
    std::vector<std::string> unusable;          ///< one sentence per unusable file
};

/// Finds the photograph of each view as `folder`/name. Backslashes in names may separate folders,
/// and names may begin with `images` or the name of `folder`. Otherwise a file is used whose name
/// differs only in case or file extension: A.JPG for a.png. Names that lead out of the folder count
/// as missing. A file whose aspect ratio differs from its camera's is unusable. Reads the headers
/// of all files in parallel. Throws InputError if the folder is missing or no photograph is usable.
Photographs find_photographs(const Scene& scene, const std::filesystem::path& folder);

/// Finds the masks of the views in the same way, as `folder`/NAME.png. NAME is the photograph's
/// name with its extension, as in COLMAP, or without. Throws like find_photographs().
Photographs find_masks(const Scene& scene, const std::filesystem::path& folder);

/// The photographs and masks of a run.
struct RunImages {
    std::optional<Photographs> photographs;
    std::optional<Photographs> masks; ///< also in Photographs::masks
};

/// Whether a run with these options reads photographs.
inline bool reads_photographs(const Options& options)
{
    return options.dense.dense || options.texture.texture || !options.images.empty();
}

/// Finds the photographs and masks that the options need. Without Options::images, photographs are
/// those beside the model, which is a folder or a file; empty if there is no model. Notes name this
/// folder, views without files, and unusable files. Throws UsageError if photographs are needed and
/// no folder is known, and InputError as find_photographs() does, or if the largest photograph
/// needs more than half of the memory limit.
RunImages find_images(const Scene& scene, const Options& options,
                      const std::filesystem::path& model, Log& log);

/// Logs one note about unusable photographs. Each sentence must begin with a path and a colon.
void note_unusable(const std::vector<std::string>& sentences, Log& log);

/// Returns the folder that the names of a model's photographs are relative to, if it is found. It
/// is the folder of transforms.json, or a folder `images`. The latter is in the model's folder, or
/// beside a folder `sparse` that is the model or contains it (sparse/0), or beside nerfstudio's
/// folder `colmap` around that.
std::optional<std::filesystem::path> photographs_beside(const std::filesystem::path& model);

} // namespace vcarve
