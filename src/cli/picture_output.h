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

/// The options about photographs.
struct TextureArguments {
    std::filesystem::path images; ///< empty: a texture is made of those beside the model
    std::filesystem::path masks;  ///< empty: none
    bool texture = false;
    double scale = 1.0;

    /// Whether photographs are read at all.
    bool reads_images() const { return texture || !images.empty(); }
};

/// --images, --masks, --texture and --texture-scale, under the heading "Output".
OptionList texture_options(TextureArguments& texture);

/// The files beside a textured surface. The number of texture pages is an upper bound.
std::vector<Output> texture_outputs(const std::filesystem::path& out);

/// Throws UsageError if the format of a surface has no texture, or only a scale is given.
void check_texture(const TextureArguments& texture, const std::filesystem::path& out,
                   const ParsedArguments& given);

/// Finds the photographs of a model in the given folder, or in `images` beside the model, with a
/// note. Notes also name views without photographs and unreadable files. Throws InputError as
/// find_photographs() does, and UsageError if there is no such folder.
Photographs photographs_of(const TextureArguments& arguments, const std::filesystem::path& model,
                           const Scene& scene, Log& log);

/// Finds the masks of --masks, if it is given, with notes about views without one and unreadable
/// files. Throws InputError as find_masks() does.
std::optional<Photographs> masks_of(const TextureArguments& arguments, const Scene& scene,
                                    Log& log);

/// The surface without the faces that most views see only in masked pixels, as the stage "masks".
/// Throws InputError if no face is left.
TriMesh unmasked(const TriMesh& mesh, const Scene& scene, const Photographs& masks, Log& log);

/// The files of photographs or masks, which no output may replace.
std::vector<Output> files_of(const Photographs& photographs);

/// Throws InputError if the largest photograph needs more than half of the memory limit in bytes,
/// unless that is 0.
void require_photo_memory(const Photographs& photographs, std::int64_t most);

/// The options, and the memory limit of the run in bytes, 0 for none.
struct TextureTask {
    const TextureArguments& arguments;
    std::int64_t most_memory = 0;
};

/// Colors a surface by the photographs of a scene in the same frame, and textures it if wanted.
TexturedMesh textured(TriMesh mesh, const Scene& scene, const Photographs& photographs,
                      const TextureTask& task, Log& log);

/// The options about the picture.
struct PreviewArguments {
    std::filesystem::path out; ///< empty: none
    std::string view = "auto";
};

/// --preview and --view, under a command's heading "Output".
OptionList preview_options(PreviewArguments& preview);
/// Throws UsageError if the name does not end in .png, or only --view is given.
void check_preview(const PreviewArguments& preview, const ParsedArguments& given);

/// The picture of a run, if requested; otherwise it does nothing.
class PreviewOutput {
  public:
    explicit PreviewOutput(PreviewArguments arguments) : arguments_(std::move(arguments)) {}

    /// Chooses the viewpoint. Throws UsageError, as choose_eye does.
    void stand_in(const Scene& scene);
    /// Draws a mesh in the frame of that scene, as the stage "preview".
    void add(const std::string& name, const TriMesh& mesh, const Texture& texture, Log& log);
    /// Writes the file; it is empty if no mesh was added.
    void write();
    /// "file" and "view", the name of the viewpoint's image; null without a picture.
    Json record() const;

  private:
    PreviewArguments arguments_;
    std::optional<Preview> preview_;
    bool is_empty_ = true;
};

} // namespace vcarve::cli
