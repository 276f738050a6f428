#pragma once

#include "base/progress.h"
#include "cli/command_line.h"
#include "cli/input_output.h"
#include "cli/run_record.h"
#include "picture/preview.h"
#include "texture/texture_mesh.h"
#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// The options of photographs.
struct TextureArguments {
    std::filesystem::path images; ///< if empty, a texture uses `images` beside the model
    std::filesystem::path masks;  ///< empty if not given
    bool texture = false;
    double scale = 1.0;

    /// Whether photographs are read at all.
    bool reads_images() const { return texture || !images.empty(); }
};

/// --images, --masks, --texture and --texture-scale, under the heading "Output".
OptionList texture_options(TextureArguments& texture);

/// The files beside a textured mesh. The number of texture pages is an upper bound.
std::vector<Output> texture_outputs(const std::filesystem::path& out);

/// Throws UsageError if the mesh format has no texture, or --texture-scale lacks --texture.
void check_texture(const TextureArguments& texture, const std::filesystem::path& out,
                   const ParsedArguments& given);

/// Finds the photographs of a model in the given folder, or in `images` beside the model, with a
/// note. Notes also name views without photographs and unreadable files. Throws InputError as
/// find_photographs() does, and UsageError if there is no such folder.
Photographs photographs_of(const TextureArguments& arguments, const std::filesystem::path& model,
                           const Scene& scene, Log& log);

/// Finds the masks of --masks, if given. Notes name views without masks and unreadable files.
/// Throws InputError as find_masks() does.
std::optional<Photographs> masks_of(const TextureArguments& arguments, const Scene& scene,
                                    Log& log);

/// Removes the faces that most views see only in masked pixels, as the stage "masks". Throws
/// InputError if no face is left.
TriMesh unmasked(const TriMesh& mesh, const Scene& scene, const Photographs& masks, Log& log);

/// The files of photographs or masks, which no output may replace.
std::vector<Output> files_of(const Photographs& photographs);

/// Throws InputError if the largest photograph needs more than half of `most`, the memory limit in
/// bytes; 0 disables.
void require_photo_memory(const Photographs& photographs, std::int64_t most);

/// The options, and the memory limit of the run in bytes; 0 disables.
struct TextureTask {
    const TextureArguments& arguments;
    std::int64_t most_memory = 0;
};

/// Colors a mesh from the photographs of a scene in the same frame; textures it with --texture.
TexturedMesh textured(TriMesh mesh, const Scene& scene, const Photographs& photographs,
                      const TextureTask& task, Log& log);

/// The options of the picture.
struct PreviewArguments {
    std::filesystem::path out; ///< empty if not requested
    std::string view = "auto";
};

/// --preview and --view, under the heading "Output".
OptionList preview_options(PreviewArguments& preview);
/// Throws UsageError if the file name does not end in .png, or --view lacks --preview.
void check_preview(const PreviewArguments& preview, const ParsedArguments& given);

/// Reports errors of photographs, masks and the name of --view before points are read: throws as
/// photographs_of(), masks_of() and named_view() do. Does nothing for a scan without a model. Cost:
/// reading the views, and the header of each photograph.
void check_images(const ModelArguments& model, const TextureArguments& texture, bool needs_photos,
                  const PreviewArguments& preview);

/// The picture of a run, if requested; otherwise it does nothing.
class PreviewOutput {
  public:
    explicit PreviewOutput(PreviewArguments arguments) : arguments_(std::move(arguments)) {}

    /// Chooses the viewpoint. Throws UsageError, as choose_eye does.
    void set_scene(const Scene& scene);
    /// Draws a mesh in the frame of that scene, as the stage "preview".
    void add(const std::string& name, const TriMesh& mesh, const Texture& texture, Log& log);
    /// Writes the file; the picture is empty if no mesh was added.
    void write();
    /// "file" and "view", the name of the viewpoint's image; null without a picture.
    Json record() const;

  private:
    PreviewArguments arguments_;
    std::optional<Preview> preview_;
    bool is_empty_ = true;
};

} // namespace vcarve::cli
