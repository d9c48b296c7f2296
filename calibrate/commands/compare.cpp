#include "calibrate/commands/compare.hpp"

#include "calibrate/comparison/comparison.hpp"
#include "common/atomic_file.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

void print_misfit(const std::string& which, const Misfit& misfit) {
    if (misfit.n == 0) return;
    fmt::print("{:<16} {} data, rms {:.2f} %, {:.2f} standard errors (chi2 {:.1f})\n",
               which, misfit.n, 100 * misfit.rms_relative, misfit.whitened_rms,
               misfit.chi2);
}

void print_findings(const Comparison& comparison) {
    constexpr std::size_t most = 8;
    const std::vector<std::string> words = findings(comparison);
    if (words.empty()) {
        fmt::print("nothing stands out beyond the errors\n");
        return;
    }
    fmt::print("what stands out:\n");
    for (std::size_t i = 0; i < std::min(most, words.size()); ++i)
        fmt::print("  {}\n", words[i]);
    if (words.size() > most)
        fmt::print("  and {} more in the file\n", words.size() - most);
}

}  // namespace

void compare(const InputPaths& paths, const std::filesystem::path& posterior,
             const std::filesystem::path& out) {
    require_writable(out,
                     {paths.settings, paths.measurements, paths.emulator, posterior});
    const StudyInputs inputs(paths);
    const SpreadLevels levels = spread_levels(inputs.settings);
    const StoredPosterior stored =
        read_posterior(posterior, inputs.space, levels, inputs.settings);
    const ComparisonInputs all{inputs.settings, inputs.set,       inputs.space,
                               levels,          inputs.predictor, stored};
    const Comparison comparison = compare_with_measurements(all);
    write_text_atomically(out, to_json(comparison, all).dump(1) + "\n");
    fmt::print("{}", parameter_table(comparison.parameters));
    print_misfit("fitted shots", comparison.fitted);
    print_misfit("held-back shots", comparison.held_back);
    print_findings(comparison);
}

}  // namespace taylorcal::calibrate
