#pragma once

#include "cli/manual.h"
#include "cli/model_input.h"
#include "cli/option_parser.h"
#include "cli/outputs.h"
#include "cli/placing.h"
#include "cli/preview_output.h"
#include "cli/texture_output.h"
#include "vcarve/options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve::cli {

/// How the program writes what it computes.
struct OutputOptions {
    bool ascii = false;
    bool attributes = false;
    WordOrVector offset;   ///< the words are those of OffsetWord
    std::string transform; ///< a file, or a scale; empty for none
    UpWord up = UpWord::automatic;
    bool quiet = false;
    bool verbose = false;
};

/// Everything the command line says.
struct MeshArguments {
    ModelArguments model;
    std::filesystem::path out;
    TextureArguments texture;
    PreviewArguments preview;
    std::filesystem::path stats;  ///< empty: not written
    std::filesystem::path report; ///< ...
    std::filesystem::path work;   ///< empty where nothing is kept between stages
    bool keeps_work = false;      ///< also at the end
    bool checks = false;          ///< the surface, also where no record is written
    std::filesystem::path replay; ///< the surface whose command is asked for
    std::string command;          ///< as it was typed
    OutputOptions output;
    std::optional<Similarity> transform; ///< what --transform says, once it is read
    Options options;
    HelpOptions help;
};

/// All options of the command, as --help lists them.
OptionList options_of(MeshArguments& arguments);
OptionList options_of(OutputOptions& output);

/// Throws UsageError where operands are missing or too many, the output has a name of no format, or
/// two outputs would be one file.
MeshArguments read_mesh_arguments(const ParsedArguments& given);

/// What a user can read about the bare form, `colmap-vcarve MODEL OUT.ply`.
Manual mesh_manual();

/// All that a run may write. How many pages a texture has shows late, so here it has many: fewer
/// hold all the texels there may be (TextureOptions).
std::vector<Output> outputs_of(const MeshArguments& arguments);

} // namespace vcarve::cli
