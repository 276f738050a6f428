#pragma once

#include "cli/model_input.h"
#include "cli/option_parser.h"
#include "cli/option_table.h"
#include "cli/outputs.h"
#include "cli/preview_output.h"
#include "vcarve/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::cli {

enum class OffsetWord { none, automatic };
inline constexpr const char* kOffsetWords[] = {"none", "auto"};

/// What the program writes, whatever it computes.
struct OutputOptions {
    bool ascii = false;
    bool attributes = false;
    bool quiet = false;
    WordOrVector offset; ///< one of kOffsetWords

    void visit(OptionVisitor& options)
    {
        options.stage("Output");
        options.flag(
            ascii, {.name = "ascii", .help = "Write numbers as text instead of binary; PLY only."});
        options.flag(attributes,
                     {.name = "attributes",
                      .help = "Write what vertices and faces come from: point3d_id, num_views and "
                              "error_px of each vertex, support of each face; PLY only."});
        options.word_or_vector(
            offset, kOffsetWords,
            {.name = "offset",
             .help = "What is subtracted from the coordinates that are written, and said in the "
                     "file: none; x,y,z; or auto, round numbers for a model that lies far from the "
                     "origin, so that programs that compute with floats lose nothing.",
             .min = -kUnlimited});
        options.flag(quiet, {.name = "quiet", .help = "Print nothing but errors."});
    }
};

/// Everything the command line says.
struct MeshArguments {
    ModelArguments model;
    std::filesystem::path out;
    PreviewArguments preview;
    bool with_stats = false;
    std::filesystem::path stats;
    bool with_report = false;
    std::filesystem::path report;
    std::filesystem::path work; ///< empty where --work was not given
    std::string command;        ///< as it was typed
    OutputOptions output;
    Options options;
};

/// All options of the command, as --help lists them.
std::vector<OptionRow> mesh_options();

/// Throws UsageError where operands are missing or too many, the output has a name of no format, or
/// two outputs would be one file.
MeshArguments read_mesh_arguments(const ParsedArguments& given);

/// All that a run is to write.
std::vector<Output> outputs_of(const MeshArguments& arguments);

} // namespace vcarve::cli
