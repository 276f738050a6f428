#pragma once

#include "base/progress.h"
#include "cli/option_parser.h"
#include "cli/run_record.h"
#include "picture/preview.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace vcarve::cli {

/// What the command line says of a picture.
struct PreviewArguments {
    std::filesystem::path out; ///< empty: none
    std::string view = "auto";
};

/// --preview and --view, under a command's heading "Output".
OptionList preview_options(PreviewArguments& preview);
/// Throws UsageError where the name does not end in .png, or only --view is given.
void check_preview(const PreviewArguments& preview, const ParsedArguments& given);

/// The picture of a run, if one is asked for; otherwise it does nothing.
class PreviewOutput {
  public:
    explicit PreviewOutput(PreviewArguments arguments) : arguments_(std::move(arguments)) {}

    /// Chooses the place to look from. Throws UsageError, as choose_eye does.
    void stand_in(const Scene& scene);
    /// Draws a mesh in the frame of that scene, as the stage "preview".
    void add(const std::string& name, const TriMesh& mesh, const Texture& texture, Log& log);
    /// Writes the file, which shows nothing where no mesh was added.
    void write();
    /// "file" and "view", the name of the image that was looked from; null where there is none.
    Json record() const;

  private:
    PreviewArguments arguments_;
    std::optional<Preview> preview_;
    bool is_empty_ = true;
};

} // namespace vcarve::cli
