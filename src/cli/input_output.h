#pragma once

#include "cli/run_record.h"
#include "io/input/read_model.h"
#include "io/input/run_input.h"
#include "model/similarity.h"
#include "options/declared.h"
#include "options/option.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vcarve::cli {

/// The operand MODEL and the options that choose its points.
struct ModelArguments : PointsArguments {
    std::filesystem::path path;
};

/// A file that a command writes or reads, and its name in messages.
struct Output {
    const char* name;
    std::filesystem::path path;
};

/// The verbosity and the thread count.
struct ConsoleArguments {
    bool quiet = false;
    bool verbose = false;
    int threads = 0; ///< 0 uses all
};

/// --quiet (with its help), --verbose and --threads, under the heading "Run".
OptionList options_of(ConsoleArguments& arguments, const char* quiet_help);

/// Throws UsageError if two outputs are the same file.
void require_distinct(std::span<const Output> outputs);

/// Throws UsageError if an output would replace a file of the input, by any path or link. These
/// files are input_files(), photographs, masks, the images of the views, and `others`. Costs little
/// if no output exists yet.
void keep_inputs(std::span<const Output> outputs, const RunInput& input,
                 const std::vector<Output>& others);

/// Throws UsageError if an output cannot be written; call it before the work starts. A run that
/// fails or is ended by a signal then leaves no partial file, and no folder `scratch` if given.
void prepare_outputs(std::span<const Output> outputs, const std::filesystem::path& scratch = {});

/// A unique path beside the output, or in the temporary folder if the output is a device.
std::filesystem::path folder_beside(const std::filesystem::path& out);

/// {"model", "folder", "format", "cloud", "points", "views", "rays"} of an input.
Json input_json(const RunInput& input, const ReadModel& model);

} // namespace vcarve::cli
