#include "solver/commands/batch.hpp"

#include "common/atomic_file.hpp"
#include "common/option_text.hpp"
#include "common/program_code.hpp"
#include "common/progress.hpp"
#include "common/sha256.hpp"
#include "common/simd.hpp"
#include "solver/commands/journal.hpp"
#include "solver/commands/run_table.hpp"
#include "solver/commands/solver_provenance.hpp"
#include "solver/impact/simulate.hpp"
#include "solver/impact/thread_clock.hpp"

#include <exception>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <omp.h>
#include <spdlog/spdlog.h>

namespace taylorcal::commands {
namespace {

FinishedRun compute(std::int64_t run_id, const impact::ImpactCase& impact_case,
                    const Simulate& simulate) {
    const double start = impact::thread_seconds();
    FinishedRun run;
    try {
        run = row_of(run_id, simulate(impact_case));
    } catch (const std::exception& error) {
        run = failed_row(run_id, error.what());
    }
    run.cpu_s = impact::thread_seconds() - start;
    return run;
}

/// What a batch computes, to recognise its journal.
nlohmann::json journal_header(const Design& design, const nlohmann::json& configuration) {
    std::string inputs = nlohmann::json(design.input_names).dump();
    for (std::size_t row = 0; row < design.rows(); ++row) {
        const auto values = design.inputs.row(static_cast<Eigen::Index>(row));
        inputs += fmt::format("\n{} {} {}", design.run_id[row], design.seed[row],
                              design.shape[row]);
        for (const double value : values) inputs += fmt::format(" {}", value);
    }
    return {{"schema", "taylorcal/journal/2"},
            {"solver_code", program_code()},
            {"simd", "TAYLORCAL_SIMD=" + simd::name(simd::variant())},
            {"configuration_digest", sha256(configuration.dump())},
            {"design_digest", sha256(inputs)}};
}

/// Provenance of many runs: each has its own seed, in the table.
nlohmann::json batch_provenance(const nlohmann::json& configuration) {
    nlohmann::json record = solver_provenance(0, configuration);
    record["seed"] = "one a run, see the dataset \"seed\"";
    return record;
}

/// Computes the rows `missing`; each is in the journal before the next begins.
void compute_rows(const std::vector<std::size_t>& missing, const Design& design,
                  const std::vector<impact::ImpactCase>& cases, int threads,
                  const Simulate& simulate, Journal& journal, RunCache& cache,
                  std::vector<FinishedRun>& runs) {
    Progress progress("runs", missing.size());
    std::exception_ptr failure;
    const auto count = static_cast<std::int64_t>(missing.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::int64_t i = 0; i < count; ++i) {
        const std::size_t row = missing[static_cast<std::size_t>(i)];
        bool give_up = false;
#pragma omp critical(taylorcal_batch)
        give_up = failure != nullptr;
        if (give_up) continue;
        FinishedRun run = compute(design.run_id[row], cases[row], simulate);
#pragma omp critical(taylorcal_batch)
        {
            try {
                journal.append(run);
                progress.advance(
                    1, fmt::format("run {} {}", run.run_id, status_name(run.status)));
            } catch (...) {
                failure = std::current_exception();
            }
            cache.keep(row, run);
            runs[row] = std::move(run);
        }
    }
    if (failure) std::rethrow_exception(failure);
}

void report_failures(const std::vector<FinishedRun>& runs) {
    for (const FinishedRun& run : runs)
        if (run.status != impact::Status::stopped)
            spdlog::warn("run {} {}: {}", run.run_id, status_name(run.status),
                         run.reason);
}

}  // namespace

void run_batch(const Design& design, const std::vector<impact::ImpactCase>& cases,
               const nlohmann::json& configuration, const std::filesystem::path& out,
               int threads, const Simulate& simulate, RunCache cache) {
    Journal journal(out.string() + ".journal.jsonl",
                    journal_header(design, configuration));
    std::map<std::int64_t, FinishedRun> found;
    for (const FinishedRun& run : journal.found()) found[run.run_id] = run;

    std::vector<FinishedRun> runs(design.rows());
    std::vector<std::size_t> missing;
    std::size_t cached = 0;
    for (std::size_t row = 0; row < design.rows(); ++row) {
        const auto known = found.find(design.run_id[row]);
        if (known != found.end()) {
            runs[row] = known->second;
        } else if (const auto run = cache.found(row)) {
            runs[row] = *run;
            ++cached;
        } else {
            missing.push_back(row);
        }
    }
    if (!found.empty())
        spdlog::info("{} of {} runs are in the journal already", found.size(),
                     design.rows());
    if (cached > 0) spdlog::info("{} of {} runs are in the cache", cached, design.rows());
    compute_rows(missing, design, cases, threads, simulate, journal, cache, runs);
    report_failures(runs);
    write_database(out, {design, runs, configuration, batch_provenance(configuration)});
    journal.remove();
}

void add_batch(CLI::App& app) {
    struct Options {
        std::string design;
        std::string configuration;
        std::string out;
        std::string rows = ":";
        std::string cache;
        int threads = 0;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("batch", "Compute the runs of a design in parallel");
    command->add_option("design", options->design, "design.h5: one row a run")
        ->required();
    command->add_option("--config", options->configuration,
                        "solver.json: geometry, fidelity, material; all optional");
    command->add_option("--out", options->out, "database to write (HDF5)")->required();
    command
        ->add_option("--rows", options->rows,
                     "first:last rows of the design, from 0, last excluded")
        ->capture_default_str();
    command
        ->add_option("--threads", options->threads,
                     "threads (0, the default: one a processor)")
        ->check(threads_problem);
    command
        ->add_option("--cache", options->cache,
                     "folder of finished runs that studies share: looked up and added to")
        ->envname("TAYLORCAL_RUN_CACHE");
    command->footer(
        "Sample runs:\n"
        "  solver batch design.h5 --config solver.json --out database.h5\n"
        "  solver batch design.h5 --config solver.json --rows 0:50 --out chunk_0.h5\n"
        "A batch that was killed goes on where it was when it is started again.");
    command->callback([options] {
        require_writable(options->out, {options->design, options->configuration});
        const Configuration configuration = read_configuration(options->configuration);
        const Design whole = read_design(options->design);
        const Design design = whole.subset(parse_rows(options->rows, whole.rows()));
        const auto cases = make_cases(design, configuration, options->design);
        run_batch(design, cases, configuration.document, options->out,
                  options->threads > 0 ? options->threads : omp_get_max_threads(),
                  impact::simulate, RunCache(options->cache, design, configuration));
    });
}

}  // namespace taylorcal::commands
