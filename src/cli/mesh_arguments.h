#pragma once

#include "cli/command_line.h"
#include "cli/dense_run.h"
#include "cli/input_output.h"
#include "cli/picture_output.h"
#include "run/digest.h"
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
    WordOrVector up;       ///< the words are those of UpWord
    bool upright = false;
    bool quiet = false;
    bool verbose = false;
};

/// Everything the command line says.
struct MeshArguments {
    ModelArguments model;
    std::filesystem::path out;
    DenseArguments dense;
    TextureArguments texture;
    PreviewArguments preview;
    std::filesystem::path stats;  ///< empty: not written
    std::filesystem::path report; ///< ...
    std::filesystem::path work;   ///< empty where nothing is kept between stages
    bool keeps_work = false;      ///< at the end
    bool checks = false;          ///< the mesh, also without a record
    std::string command;          ///< as it was typed
    OutputOptions output;
    std::optional<Similarity> transform; ///< what --transform says, once it is read
    Options options;
    HelpOptions help;
};

/// All options of the command, as --help lists them.
OptionList options_of(MeshArguments& arguments);
OptionList options_of(OutputOptions& output);

/// Throws UsageError for missing or stray operands, an unknown file extension, or two outputs in
/// one file.
MeshArguments read_mesh_arguments(const ParsedArguments& given);

/// The comments of the mesh file: the program, the digest of the scene, and options that affect the
/// mesh and differ from the defaults. No paths, no threads: equal runs write equal files.
std::vector<std::string> record_comments(const MeshArguments& arguments, const Digest& scene);

/// The help of `colmap-vcarve MODEL OUT.ply`.
Manual mesh_manual();

/// All files that a run may write. The number of texture pages is an upper bound.
std::vector<Output> outputs_of(const MeshArguments& arguments);

} // namespace vcarve::cli
