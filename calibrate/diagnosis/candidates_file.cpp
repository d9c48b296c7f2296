#include "calibrate/diagnosis/candidates_file.hpp"

#include "common/json_reader.hpp"

#include <cmath>
#include <set>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

AmplitudePrior read_prior(const JsonReader& reader) {
    reader.only({"kind", "scale"});
    const std::vector<std::string> kinds{"half_normal", "normal", "uniform"};
    AmplitudePrior prior;
    const std::string kind = reader.word("kind", kinds);
    prior.kind = kind == "half_normal" ? AmplitudePrior::Kind::half_normal
                 : kind == "normal"    ? AmplitudePrior::Kind::normal
                                       : AmplitudePrior::Kind::uniform;
    prior.scale = reader.number("scale");
    if (!(prior.scale > 0) || !std::isfinite(prior.scale))
        reader.fail("scale", fmt::format("= {} (expected a width above 0, in the unit of "
                                         "the amplitude)",
                                         prior.scale));
    return prior;
}

Candidate read_candidate(const JsonReader& reader) {
    reader.only({"name", "kind", "symbol", "unit", "base", "lowest", "highest", "prior",
                 "signed", "description", "equation", "source"});
    Candidate c;
    c.name = reader.text("name");
    c.is_constant = reader.word("kind", {"effect", "constant"}) == "constant";
    c.unit = reader.text("unit");
    c.base = reader.number("base");
    c.lowest = reader.number("lowest");
    c.highest = reader.number("highest");
    c.prior = read_prior(reader.object("prior"));
    if (!(c.lowest <= c.base && c.base <= c.highest && c.lowest < c.highest))
        reader.fail(
            "base",
            fmt::format("= {} is not within lowest = {} to highest = {}. Widen the "
                        "range or correct the value at which {} is absent.",
                        c.base, c.lowest, c.highest, c.name));
    // An amplitude that cannot be negative keeps to one side whatever the range says.
    if (!reader.boolean("signed", true)) c.lowest = c.base;
    if (c.prior.kind == AmplitudePrior::Kind::half_normal) c.lowest = c.base;
    if (!(c.prior.mass(c.lower(), c.upper()) > 0))
        reader.fail("prior",
                    "leaves nothing within lowest to highest. Give the range "
                    "the side on which the prior lies.");
    return c;
}

}  // namespace

std::vector<Candidate> read_candidates(const std::filesystem::path& path) {
    const JsonReader reader = JsonReader::from_file(path);
    reader.only({"candidates"});
    std::vector<Candidate> candidates;
    std::set<std::string> names;
    for (const JsonReader& entry : reader.objects("candidates")) {
        candidates.push_back(read_candidate(entry));
        if (!names.insert(candidates.back().name).second)
            entry.fail("name", fmt::format("= \"{}\" is there twice. Remove one of them.",
                                           candidates.back().name));
    }
    if (candidates.empty())
        reader.fail("candidates",
                    "is empty: there is nothing to tell apart. List effects "
                    "or constants that the study keeps fixed.");
    return candidates;
}

}  // namespace taylorcal::calibrate
