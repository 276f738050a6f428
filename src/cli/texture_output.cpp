#include "cli/texture_output.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vcarve::cli {

namespace fs = std::filesystem;

OptionList texture_options(TextureArguments& texture)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "images",
          .unit = "folder",
          .help = "Where the photographs are that the model was made of: vertices get the colours "
                  "that all photographs agree on, instead of those of single pixels."},
         &texture.images},
        {kStage,
         {.name = "texture",
          .help = "Cover the surface with the photographs of --images, or of the folder `images` "
                  "beside the model: within OUT.glb, or as JPEG files beside OUT.obj or OUT.ply."},
         &texture.texture},
        {kStage,
         {.name = "texture-scale",
          .help = "How many texels of the texture a pixel of the photographs becomes, along a "
                  "side.",
          .min = 0.01,
          .max = 4.0,
          .tuning = true},
         &texture.scale},
    };
}

void check_texture(const TextureArguments& texture, const fs::path& out,
                   const ParsedArguments& given)
{
    if (given.has("texture-scale") && !texture.texture) {
        throw UsageError("--texture-scale is of the texture of --texture, which was not given");
    }
    const std::string end = lower_case_end(out);
    if (texture.texture && end != ".glb" && end != ".obj" && end != ".ply") {
        throw UsageError(fmt::format("cannot write {} with --texture: the name of a textured "
                                     "surface must end with .glb, .obj or .ply",
                                     out.string()));
    }
}

Photographs photographs_of(const TextureArguments& arguments, const fs::path& model,
                           const Scene& scene, Log& log)
{
    fs::path folder = arguments.images;
    if (folder.empty()) {
        const std::optional<fs::path> beside = photographs_beside(model);
        if (!beside) {
            throw UsageError(fmt::format("--texture needs the photographs of the model, and there "
                                         "is no folder `images` beside {}; say with --images where "
                                         "they are",
                                         model.string()));
        }
        folder = *beside;
        log.note(fmt::format("the photographs are taken from {}", folder.string()));
    }
    Photographs photographs = find_photographs(scene, folder);
    if (photographs.missing > 0) {
        log.note(fmt::format("{} of {} views have no photograph in {}", photographs.missing,
                             scene.views.size(), folder.string()));
    }
    for (const std::string& sentence : photographs.unreadable) {
        log.note(sentence);
    }
    return photographs;
}

TexturedMesh textured(TriMesh mesh, const Scene& scene, const Photographs& photographs,
                      const TextureTask& task, Log& log)
{
    // Half of what is allowed: the surface, colours of faces and four photographs are there, too.
    constexpr std::int64_t kBytesOfTexel = 7;
    TextureOptions options = {.scale = task.arguments.scale,
                              .only_colors = !task.arguments.texture};
    if (task.most_memory > 0) {
        options.most_texels = std::min(
            options.most_texels, static_cast<std::size_t>(task.most_memory / 2 / kBytesOfTexel));
    }
    const std::vector<CalibratedPhoto> photos = calibrated_photos(scene, photographs, mesh.offset);
    return texture_mesh(std::move(mesh), photos, options, log);
}

} // namespace vcarve::cli
