#pragma once

#include "cli/command_line.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vcarve::cli {

/// A command of a program.
struct Command {
    std::string name; ///< first word of the command line; empty for the bare form
    std::function<Manual()> manual;
    std::function<void(const ParsedArguments&)> run;
};

/// The commands of colmap-vcarve, the bare form first.
std::vector<Command> commands();

/// Runs a command line; `arguments` are the words after the program's name. Results go to files,
/// the log to stderr, and only requested texts (--help, --version, tables of `compare`) to stdout.
/// Throws UsageError and InputError.
void run_command_line(std::span<const std::string> arguments, std::span<const Command> commands);

/// `colmap-vcarve MODEL OUT.ply`. Throws UsageError and InputError.
void run_mesh(const ParsedArguments& given);

/// `colmap-vcarve compare MODEL A.ply ...`: prints a table of figures with one column per mesh, and
/// writes the files of --json, --preview and --report. Throws UsageError and InputError.
Manual compare_manual();
void run_compare(const ParsedArguments& given);

/// `colmap-vcarve texture MODEL MESH OUT.glb`: textures an existing mesh with the photographs of a
/// model. Throws UsageError and InputError.
Manual texture_manual();
void run_texture(const ParsedArguments& given);

/// `colmap-vcarve refine MODEL MESH OUT.ply`: moves the vertices of an existing mesh to where the
/// photographs of a model agree. Throws UsageError and InputError.
Manual refine_manual();
void run_refine(const ParsedArguments& given);

} // namespace vcarve::cli
