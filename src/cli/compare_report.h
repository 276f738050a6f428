#pragma once

#include "base/progress.h"
#include "cli/run_record.h"
#include "compare/compare.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::cli {

/// The page of a comparison, if one is asked for; otherwise it does nothing and keeps nothing.
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
