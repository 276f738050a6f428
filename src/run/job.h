#pragma once

#include "io/input/find_input.h"
#include "run/digest.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// Something that a result depends on, in words: {"--quality", "1"}.
struct JobFact {
    std::string name;
    std::string value;

    bool operator==(const JobFact&) const = default;
};

/// All that a result depends on: two runs of equal jobs make the same bytes, so one may go on with
/// what the other made. One line a fact, without line breaks or tabs.
using Job = std::vector<JobFact>;

/// A line a fact: its name, a tab, its value.
std::string job_text(const Job& job);
Digest digest_of(const Job& job);

/// The digest of all views and points, whichever files they were read from and in whatever order
/// the points stand there. Points that are nowhere (is_place()) do not count. Cost: that of the
/// digest of their bytes, and a sort.
Digest digest_of(const Scene& scene);

/// Which program it is: another version, or one built by another compiler, may round otherwise.
JobFact program_fact();

/// A file by its size and a digest of its content; where it lies and when it was written do not
/// matter. Throws InputError where it cannot be read.
JobFact file_fact(const std::string& name, const std::filesystem::path& path,
                  const Progress& progress = {});

/// The files that are read of an input, and what it says beside them. Cost: reads them all, see
/// digest_of_file.
Job input_facts(const FoundInput& input, const Progress& progress = {});

/// Options as facts, but for those under the heading "Run", which leave the result as it is. Of a
/// region's file the content counts.
Job option_facts(Options options);

} // namespace vcarve
