#pragma once

#include "io/input/find_input.h"
#include "io/work/digest.h"
#include "vcarve/option_visitor.h"

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

/// Which program it is: another version, or one built by another compiler, may round otherwise.
JobFact program_fact();

/// A file by its size and a digest of its content; where it lies and when it was written do not
/// matter. Throws InputError where it cannot be read.
JobFact file_fact(const std::string& name, const std::filesystem::path& path,
                  const Progress& progress = {});

/// The files that are read of an input, and what it says beside them. Cost: reads them all, see
/// digest_of_file.
Job input_facts(const FoundInput& input, const Progress& progress = {});

/// Lists options as facts, but for those under the heading "Run" (threads, memory and the like):
/// what stands there must leave the result as it is. Of a region's file the content counts.
class OptionFacts final : public OptionVisitor {
  public:
    void stage(const char* title) override;
    void number(double& value, const OptionInfo& info) override;
    void count(int& value, const OptionInfo& info) override;
    void bytes(std::int64_t& value, const OptionInfo& info) override;
    void flag(bool& value, const OptionInfo& info) override;
    void choice(int& value, std::span<const char* const> names, const OptionInfo& info) override;
    void word_or_vector(WordOrVector& value, std::span<const char* const> words,
                        const OptionInfo& info) override;
    void region(RegionChoice& value, const OptionInfo& info) override;

    const Job& facts() const { return facts_; }

  private:
    void add(const OptionInfo& info, std::string value);

    Job facts_;
    bool shapes_result_ = true; ///< the options under the present heading
};

template <typename Options>
Job option_facts(Options options)
{
    OptionFacts facts;
    options.visit(facts);
    return facts.facts();
}

} // namespace vcarve
