#pragma once

#include "cli/option_parser.h"
#include "cli/run_record.h"
#include "texture/texture_mesh.h"
#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace vcarve::cli {

/// What the command line says of photographs.
struct TextureArguments {
    std::filesystem::path images; ///< empty: those beside the model, where there is to be a texture
    bool texture = false;
    double scale = 1.0;

    /// Whether photographs are read at all.
    bool reads_images() const { return texture || !images.empty(); }
};

/// --images, --texture and --texture-scale, under the heading "Output".
OptionList texture_options(TextureArguments& texture);

/// Throws UsageError where the format of a surface holds no texture, or only a scale is given.
void check_texture(const TextureArguments& texture, const std::filesystem::path& out,
                   const ParsedArguments& given);

/// The photographs of a model: of the folder that is given, or `images` beside the model, of which
/// a note tells. Notes say how many views have none, and which cannot be read. Throws InputError as
/// find_photographs() does, and UsageError where there is no such folder.
Photographs photographs_of(const TextureArguments& arguments, const std::filesystem::path& model,
                           const Scene& scene, Log& log);

/// What is to be done, and how many bytes the run may take, 0 for no limit.
struct TextureTask {
    const TextureArguments& arguments;
    std::int64_t most_memory = 0;
};

/// Colours a surface by the photographs of a scene, in whose frame it is, and covers it with them
/// where that is wanted.
TexturedMesh textured(TriMesh mesh, const Scene& scene, const Photographs& photographs,
                      const TextureTask& task, Log& log);

} // namespace vcarve::cli
