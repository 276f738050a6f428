#pragma once

#include "io/images/find_photographs.h"
#include "io/input/find_input.h"
#include "options/option.h"
#include "run/digest.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// A name and value that the result depends on, such as {"--quality", "1"}.
struct JobFact {
    std::string name;
    std::string value;

    bool operator==(const JobFact&) const = default;
};

/// Everything that the result depends on: runs of equal jobs make the same bytes, so one can resume
/// the other. Facts contain no line breaks or tabs.
using Job = std::vector<JobFact>;

/// One line per fact: its name, a tab, its value.
std::string job_text(const Job& job);
Digest digest_of(const Job& job);

/// The digest of all views and points. It does not depend on the files they were read from, or on
/// the order of the points. Points with invalid positions (is_valid_position()) do not count. Cost:
/// a sort and the digest of the bytes.
Digest digest_of(const Scene& scene);

/// The program's version and compiler, because other versions and compilers may round differently.
JobFact program_fact();

/// The size of a file and a digest of its content; its path and time do not matter. Throws
/// InputError if it cannot be read.
JobFact file_fact(const std::string& name, const std::filesystem::path& path,
                  const Progress& progress = {});

/// The files of an input, and the options that select and complete them. Cost: reads all files, see
/// digest_of_file().
Job input_facts(const FoundInput& input, const Progress& progress = {});

/// The content of photographs or masks. Cost: reads all files.
Job image_facts(const std::string& kind, const Photographs& images, const Progress& progress = {});

/// All options except those under the headings "Run" and "Photograph", which do not change what is
/// kept in files, and the size of depth maps with --dense. For a region's file, its content counts.
Job option_facts(Options options);

/// The comments of the mesh file: the program, the digest of the scene, and options that affect the
/// mesh and differ from the defaults. No paths, no threads: equal runs write equal files.
std::vector<std::string> comments_of(const Digest& scene, Options options);
/// "option max-hole=7" for each option with another value than in `defaults`; "option crop=FILE"
/// for any file. `options` has the same options.
std::vector<std::string> changed_options(const OptionList& options, const OptionList& defaults);

} // namespace vcarve
