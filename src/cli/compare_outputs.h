#pragma once

#include "base/progress.h"
#include "cli/command_line.h"
#include "cli/input_output.h"
#include "cli/picture_output.h"
#include "cli/run_record.h"
#include "compare/compare.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// The files of a comparison; an empty path is not written.
struct CompareOutputs {
    std::filesystem::path json;
    PreviewArguments preview;
    std::filesystem::path report;

    /// The files that are written.
    std::vector<std::filesystem::path> paths() const;
};

/// --json, --preview, --view and --report under a heading of their own.
OptionList output_options(CompareOutputs& outputs);
/// Throws UsageError where a name is wrong, or two would be written to one file.
void check_names(const CompareOutputs& outputs, const ParsedArguments& given);

/// Throws UsageError if an input would be replaced (see keep_inputs), or a file cannot be written.
void check_outputs(const CompareOutputs& outputs, const ModelArguments& model,
                   const std::vector<std::filesystem::path>& meshes);

/// The page of a comparison, if requested; otherwise it does nothing.
class CompareReport {
  public:
    explicit CompareReport(std::filesystem::path out) : out_(std::move(out)) {}

    /// Keeps what the page draws of the model.
    void stand_in(const Scene& scene);
    /// Keeps a surface; `column` is what the table calls it.
    void add(const std::string& column, const TriMesh& mesh);
    /// Writes the page, as the stage "report". `command` is the command line. Throws UsageError
    /// where it cannot be written.
    void write(std::span<const Comparison> comparisons, const Reference& reference,
               const std::string& command, Log& log);

  private:
    std::filesystem::path out_; ///< empty: none
    Json scene_;
    Eigen::Vector3d offset_ = Eigen::Vector3d::Zero(); ///< of the scene
    std::vector<NamedMesh> meshes_;
};

} // namespace vcarve::cli
