#pragma once

#include "cli/command_line.h"
#include "cli/input_output.h"
#include "cli/picture_output.h"
#include "io/formats/output_frame.h"
#include "vcarve/options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve::cli {

/// The options of the output.
struct OutputOptions {
    bool ascii = false;
    bool attributes = false;
    WordOrVector offset;   ///< the words are those of OffsetWord
    std::string transform; ///< a file or a scale; empty if not given
    WordOrVector up;       ///< the words are those of UpWord
    bool upright = false;
    bool quiet = false;
    bool verbose = false;
};

/// The parsed command line.
struct MeshArguments {
    ModelArguments model;
    std::filesystem::path out;
    PreviewArguments preview;
    std::filesystem::path stats;       ///< empty if not written
    std::filesystem::path report;      ///< empty if not written
    std::filesystem::path keep_points; ///< dense points; empty if not written
    std::filesystem::path work;        ///< empty if no files are kept
    bool keeps_work = false;           ///< keeps the files at the end
    int tile_points = 0;               ///< maximum number of points of a tile; 0 if memory decides
    bool checks = false;               ///< checks the mesh, also without --stats and --report
    std::string command;               ///< as typed
    OutputOptions output;
    std::optional<Similarity> transform; ///< of --transform; set by the run
    Options options;
    HelpOptions help;
};

/// All options of the command, in the order of --help.
OptionList options_of(MeshArguments& arguments);
OptionList options_of(OutputOptions& output);

/// Throws UsageError for missing or superfluous operands, an unknown file extension, or two outputs
/// with the same file.
MeshArguments read_mesh_arguments(const ParsedArguments& given);

/// The first given option that a model in tiles does not support; null if there is none.
const char* option_of_one_piece(const MeshArguments& arguments);

/// The help of `colmap-vcarve MODEL OUT.ply`.
Manual mesh_manual();

/// All files that a run may write. The number of texture pages is an upper bound.
std::vector<Output> outputs_of(const MeshArguments& arguments);

} // namespace vcarve::cli
