#include "cli/run_ranks.h"

#include "run/job.h"

namespace vcarve::cli {

Digest digest_of_options(const Options& options)
{
    Job facts = option_facts(options);
    facts.push_back(program_fact());
    return digest_of(facts);
}

} // namespace vcarve::cli
