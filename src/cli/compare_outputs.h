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

/// The output files of a comparison. An empty path is not written.
struct CompareOutputs {
    std::filesystem::path json;
    PreviewArguments preview;
    std::filesystem::path report;

    /// The files to write.
    std::vector<std::filesystem::path> paths() const;
};

/// --json, --preview, --view and --report, under the heading "Output".
OptionList output_options(CompareOutputs& outputs);
/// Throws UsageError if a file name is wrong, or two outputs have the same file.
void check_names(const CompareOutputs& outputs, const ParsedArguments& given);

/// Throws UsageError if an input would be replaced (see keep_inputs), or a file cannot be written.
void check_outputs(const CompareOutputs& outputs, const RunInput& input,
                   const std::vector<std::filesystem::path>& meshes);

/// The page of a comparison, if requested; otherwise it does nothing.
class CompareReport {
  public:
    explicit CompareReport(std::filesystem::path out) : out_(std::move(out)) {}

    /// Stores the model for the page.
    void set_scene(const Scene& scene);
    /// Stores a mesh for the page; `column` is its name in the table.
    void add(const std::string& column, const TriMesh& mesh);
    /// Writes the page, as the stage "report". `command` is the command line. Throws UsageError if
    /// it cannot be written.
    void write(std::span<const Comparison> comparisons, const Reference& reference,
               const std::string& command, Log& log);

  private:
    std::filesystem::path out_; ///< empty if not requested
    Json scene_;
    Eigen::Vector3d offset_ = Eigen::Vector3d::Zero(); ///< of the scene
    std::vector<NamedMesh> meshes_;
};

} // namespace vcarve::cli
