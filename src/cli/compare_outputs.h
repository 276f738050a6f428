#pragma once

#include "cli/model_input.h"
#include "cli/option_parser.h"
#include "cli/preview_output.h"

#include <filesystem>
#include <vector>

namespace vcarve::cli {

/// What a comparison writes beside its table; an empty path is not written.
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

/// Throws UsageError where a file that is read would be replaced (see keep_inputs), or one cannot
/// be written.
void check_outputs(const CompareOutputs& outputs, const ModelArguments& model,
                   const std::vector<std::filesystem::path>& meshes);

} // namespace vcarve::cli
