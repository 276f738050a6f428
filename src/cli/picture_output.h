#pragma once

#include "base/progress.h"
#include "cli/command_line.h"
#include "cli/input_output.h"
#include "cli/run_record.h"
#include "picture/preview.h"
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

/// The files beside a textured mesh. The number of texture pages is an upper bound.
std::vector<Output> texture_outputs(const std::filesystem::path& out);

/// Throws UsageError if the mesh format has no texture.
void require_texture_name(const std::filesystem::path& out);

/// The options of the picture.
struct PreviewArguments {
    std::filesystem::path out; ///< empty if not requested
    std::string view = "auto";
};

/// --preview and --view, under the heading "Output".
OptionList preview_options(PreviewArguments& preview);
/// Throws UsageError if the file name does not end in .png, or --view lacks --preview.
void check_preview(const PreviewArguments& preview, const ParsedArguments& given);

/// Whether the picture is drawn from the view with this name, see named_view().
bool needs_view(const PreviewArguments& preview);

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
