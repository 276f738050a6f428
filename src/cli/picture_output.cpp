#include "cli/picture_output.h"

#include "base/stage_counts.h"
#include "base/text.h"
#include "io/colmap/colmap_model.h"
#include "io/formats/textured_files.h"
#include "io/input/find_input.h"
#include "picture/eye.h"
#include "texture/masked_faces.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vcarve::cli {

namespace fs = std::filesystem;

namespace {

void note_missing(const Photographs& found, const char* kind, Log& log)
{
    if (found.missing > 0) {
        log.note(fmt::format("{} of {} have no {} in {}", grouped_digits(size_of(found.missing)),
                             counted(size_of(found.of_view.size()), "views"), kind,
                             found.folder.string()));
    }
    note_unusable(found.unusable, log);
}

/// The memory of the largest photograph with its pyramid, while it is decoded.
std::int64_t bytes_of_largest(const Photographs& photographs)
{
    constexpr std::int64_t kBytesOfPixel = 8;
    std::int64_t most = 1;
    for (const PhotographSize& size : photographs.sizes) {
        most = std::max(most, std::int64_t{size.width_px} * size.height_px);
    }
    return kBytesOfPixel * most;
}

} // namespace

OptionList texture_options(TextureArguments& texture)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "images",
          .unit = "folder",
          .help = "Take vertex colors from photographs. FOLDER has the photographs of the model. "
                  "Vertices get colors that the photographs agree on, instead of single pixels'."},
         &texture.images},
        {kStage,
         {.name = "masks",
          .unit = "folder",
          .help = "Exclude the black pixels of FOLDER/NAME.png from photograph NAME, as COLMAP "
                  "does. They give neither colors nor dense points, and faces that most views see "
                  "only in such pixels are removed.",
          .level = OptionLevel::advanced},
         &texture.masks},
        {kStage,
         {.name = "texture",
          .help = "Write a texture made of the photographs. They are in --images, or in the folder "
                  "`images` beside the model. The texture is in OUT.glb, or in JPEG files beside "
                  "OUT.obj or OUT.ply."},
         &texture.texture},
        {kStage,
         {.name = "texture-scale",
          .help = "Scale the texture to N texels per pixel of the photographs, along a side.",
          .min = 0.01,
          .max = 4.0,
          .level = OptionLevel::advanced},
         &texture.scale},
    };
}

std::vector<Output> texture_outputs(const fs::path& out)
{
    constexpr std::size_t kManyPages = 64;
    std::vector<Output> outputs;
    for (const fs::path& file : files_beside(out, kManyPages)) {
        outputs.push_back({"the texture", file});
    }
    return outputs;
}

void check_texture(const TextureArguments& texture, const fs::path& out,
                   const ParsedArguments& given)
{
    if (given.has("texture-scale") && !texture.texture) {
        throw UsageError("--texture-scale needs --texture");
    }
    const std::string end = lower_case_end(out);
    if (texture.texture && end != ".glb" && end != ".obj" && end != ".ply") {
        throw UsageError(fmt::format("cannot write {} with --texture: the name of a textured "
                                     "mesh must end with .glb, .obj or .ply",
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
            throw UsageError(
                fmt::format("found no folder `images` beside {}; name the folder of the "
                            "photographs with --images",
                            model.string()));
        }
        folder = *beside;
        log.note(fmt::format("using the photographs in {}", folder.string()));
    }
    Photographs photographs = find_photographs(scene, folder);
    note_missing(photographs, "photograph", log);
    return photographs;
}

std::optional<Photographs> masks_of(const TextureArguments& arguments, const Scene& scene, Log& log)
{
    if (arguments.masks.empty()) return std::nullopt;
    Photographs masks = find_masks(scene, arguments.masks);
    note_missing(masks, "mask", log);
    return masks;
}

TriMesh unmasked(const TriMesh& mesh, const Scene& scene, const Photographs& masks, Log& log)
{
    Stage stage(log, "masks");
    TriMesh kept = without_masked_faces(mesh, calibrated_photos(scene, masks, mesh.offset), stage);
    if (kept.faces.empty()) {
        throw InputError(fmt::format("the masks in {} exclude all faces; black pixels are "
                                     "excluded, so the masks may need to be inverted",
                                     masks.folder.string()));
    }
    stage.end(
        {{counts::kTexture.masks, size_of(masks.of_view.size() - masks.missing)},
         {counts::kTexture.unmasked, size_of(kept.faces.size()), size_of(mesh.faces.size())}});
    return kept;
}

std::vector<Output> files_of(const Photographs& photographs)
{
    std::vector<Output> files;
    for (const fs::path& file : photographs.of_view) {
        if (!file.empty()) files.push_back({"the photograph", file});
    }
    return files;
}

void require_photo_memory(const Photographs& photographs, std::int64_t most)
{
    const std::int64_t needed = bytes_of_largest(photographs);
    if (most == 0 || 2 * needed <= most) return;
    throw InputError(fmt::format("{}: the largest photograph needs {} of memory, so --max-memory "
                                 "must be at least {}, but is {}; raise it, or scale the "
                                 "photographs down",
                                 photographs.folder.string(), byte_size_text(needed),
                                 byte_size_text(2 * needed), byte_size_text(most)));
}

TexturedMesh textured(TriMesh mesh, const Scene& scene, const Photographs& photographs,
                      const TextureTask& task, Log& log)
{
    // A quarter of the memory is for the pages, half for photographs, the rest for the mesh.
    constexpr std::int64_t kBytesOfTexel = 7;
    TextureOptions options = {.scale = task.arguments.scale,
                              .only_colors = !task.arguments.texture};
    if (task.most_memory > 0) {
        options.most_texels = std::min(
            options.most_texels, static_cast<std::size_t>(task.most_memory / 4 / kBytesOfTexel));
        const std::int64_t fitting = task.most_memory / 2 / bytes_of_largest(photographs);
        options.photos_at_a_time = static_cast<std::size_t>(
            std::clamp<std::int64_t>(fitting, 1, size_of(options.photos_at_a_time)));
    }
    const std::vector<CalibratedPhoto> photos = calibrated_photos(scene, photographs, mesh.offset);
    if (photos.empty()) {
        throw InputError(fmt::format("{}: no photograph can be used, because the views have an "
                                     "unknown lens or no image size; expected one of COLMAP's "
                                     "camera models",
                                     photographs.folder.string()));
    }
    const auto found = std::ranges::count_if(photographs.of_view,
                                             [](const fs::path& file) { return !file.empty(); });
    if (const auto left_out = size_of(found) - size_of(photos.size()); left_out > 0) {
        log.note(fmt::format("photographs ignored because their lens is unknown: {}", left_out));
    }
    return texture_mesh(std::move(mesh), photos, options, log);
}

OptionList preview_options(PreviewArguments& preview)
{
    constexpr const char* kStage = "Output";
    return {
        {kStage,
         {.name = "preview",
          .help = "Draw a picture of the mesh, OUT.png. It shows the colors (back faces are "
                  "magenta) beside the normals as colors."},
         &preview.out},
        {kStage,
         {.name = "view",
          .help = "Choose the viewpoint of --preview. auto: the camera that sees most. top, "
                  "orbit: a viewpoint outside, above or oblique, that looks through the backs of "
                  "walls. Otherwise the name of an image.",
          .words = {"auto", "top", "orbit"},
          .level = OptionLevel::advanced},
         &preview.view},
    };
}

void check_preview(const PreviewArguments& preview, const ParsedArguments& given)
{
    if (given.has("view") && preview.out.empty()) {
        throw UsageError("--view needs --preview OUT.png");
    }
    if (!preview.out.empty() && lower_case_end(preview.out) != ".png") {
        throw UsageError(fmt::format("cannot write {}: the name of a picture must end with .png",
                                     preview.out.string()));
    }
}

void check_images(const ModelArguments& model, const TextureArguments& texture, bool needs_photos,
                  const PreviewArguments& preview)
{
    const bool names_view = preview.view != "auto" && preview.view != "top" &&
                            preview.view != "orbit" && !preview.out.empty();
    if (!needs_photos && texture.masks.empty() && !names_view) return;
    const FoundInput found = find_input(model.path, model.all_points());
    if (found.model.folder.empty()) return;
    ColmapViews read = read_colmap_views(found.model.folder, found.model.format);
    Scene scene;
    scene.cameras = std::move(read.cameras);
    scene.views = std::move(read.views);
    if (names_view) named_view(scene, preview.view);
    Log silent;
    masks_of(texture, scene, silent);
    if (needs_photos) photographs_of(texture, model.path, scene, silent);
}

void PreviewOutput::set_scene(const Scene& scene)
{
    if (!arguments_.out.empty()) preview_.emplace(choose_eye(scene, arguments_.view));
}

void PreviewOutput::add(const std::string& name, const TriMesh& mesh, const Texture& texture,
                        Log& log)
{
    if (!preview_) return;
    Stage stage(log, "preview");
    const std::int64_t pixels = preview_->add(name, mesh, texture);
    is_empty_ = false;
    stage.end({{counts::kOutput.pixels, pixels, kNoTotal, name}});
}

void PreviewOutput::write()
{
    if (!preview_) return;
    if (is_empty_) preview_->add("no surface", {});
    write_png(arguments_.out, preview_->picture());
}

Json PreviewOutput::record() const
{
    if (!preview_) return nullptr;
    return {{"file", arguments_.out.string()}, {"view", preview_->eye().name}};
}

} // namespace vcarve::cli
