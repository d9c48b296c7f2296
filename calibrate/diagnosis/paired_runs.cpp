#include "calibrate/diagnosis/paired_runs.hpp"

#include "common/errors.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

bool is_same(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

/// A database of runs with its columns by name.
class RunTable {
  public:
    explicit RunTable(const std::filesystem::path& path) : path_(path) {
        const Hdf5Reader file(path);
        file.expect_schema("taylorcal/database/1");
        inputs_ = file.matrix("inputs");
        outputs_ = file.matrix("outputs");
        descriptors = file.matrix("descriptors");
        input_names = file.texts_attribute("names", "inputs");
        output_names_ = file.texts_attribute("names", "outputs");
        descriptor_names = file.texts_attribute("names", "descriptors");
        shape = file.texts("shape");
        run_id = file.integers("run_id");
        seed = file.integers("seed");
        status = file.integers("status");
        require(shape.size() == status.size() && inputs_.rows() == outputs_.rows() &&
                    static_cast<std::size_t>(inputs_.rows()) == shape.size(),
                path.string() +
                    ": its tables have different numbers of rows. Make the "
                    "file again with \"solver batch\".");
    }
    std::optional<Eigen::Index> find(const std::string& name) const {
        const auto at = std::find(input_names.begin(), input_names.end(), name);
        if (at == input_names.end()) return std::nullopt;
        return at - input_names.begin();
    }
    Eigen::Index input(const std::string& name) const {
        const auto at = find(name);
        require(at.has_value(),
                fmt::format("{}: it has no input column {}. Make the file "
                            "again from this study's design.",
                            path_.string(), name));
        return *at;
    }
    /// Nothing for a size that the runs do not give.
    std::optional<Eigen::Index> output(const std::string& name) const {
        const auto at = std::find(output_names_.begin(), output_names_.end(), name);
        if (at == output_names_.end()) return std::nullopt;
        return at - output_names_.begin();
    }
    double value(std::size_t row, Eigen::Index column) const {
        return inputs_(static_cast<Eigen::Index>(row), column);
    }
    /// NaN for a size that the runs do not give.
    Eigen::VectorXd sizes(std::size_t row, const std::vector<std::string>& names) const {
        Eigen::VectorXd values =
            Eigen::VectorXd::Constant(static_cast<Eigen::Index>(names.size()),
                                      std::numeric_limits<double>::quiet_NaN());
        for (std::size_t c = 0; c < names.size(); ++c)
            if (const auto at = output(names[c]))
                values(static_cast<Eigen::Index>(c)) =
                    outputs_(static_cast<Eigen::Index>(row), *at);
        return values;
    }
    std::size_t rows() const { return shape.size(); }
    std::string where(std::size_t row) const {
        return fmt::format("{}, run {}", path_.string(), run_id[row]);
    }

    RowMatrix descriptors;
    std::vector<std::string> input_names, descriptor_names, shape;
    std::vector<std::int64_t> run_id, seed, status;

  private:
    std::filesystem::path path_;
    RowMatrix inputs_, outputs_;
    std::vector<std::string> output_names_;
};

/// Which candidate a row changes, or none.
std::optional<std::size_t> changed_candidate(
    const RunTable& table, std::size_t row, const std::vector<Candidate>& candidates,
    const std::vector<std::optional<Eigen::Index>>& columns) {
    std::optional<std::size_t> changed;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (!columns[k] || is_same(table.value(row, *columns[k]), candidates[k].base))
            continue;
        require(!changed,
                fmt::format("{}: it changes {} and {} at once (expected one candidate a "
                            "run, compared with a run that has none). Make the design "
                            "again.",
                            table.where(row), candidates[changed.value_or(0)].name,
                            candidates[k].name));
        changed = k;
    }
    return changed;
}

/// What the runs of a pair share: seed, shape and all inputs but the candidates'.
std::string pair_key(const RunTable& table, std::size_t row,
                     const std::vector<std::optional<Eigen::Index>>& candidates) {
    std::string key = fmt::format("{} {}", table.seed[row], table.shape[row]);
    for (std::size_t c = 0; c < table.input_names.size(); ++c)
        if (std::find(candidates.begin(), candidates.end(),
                      std::optional(static_cast<Eigen::Index>(c))) == candidates.end())
            key +=
                fmt::format(" {:.12g}", table.value(row, static_cast<Eigen::Index>(c)));
    return key;
}

BaseRun read_base(const RunTable& table, std::size_t row, const Settings& settings) {
    BaseRun run;
    run.run_id = table.run_id[row];
    run.shot.id = fmt::format("run {}", run.run_id);
    run.shot.shape = table.shape[row];
    run.shot.velocity_m_s = table.value(row, table.input("velocity_m_s"));
    run.shot.initial_diameter_mm = table.value(row, table.input("initial_diameter_mm"));
    run.shot.initial_length_mm = run.shot.initial_diameter_mm *
                                 table.value(row, table.input("length_to_diameter"));
    run.shot.initial_temperature_K =
        table.value(row, table.input("initial_temperature_K"));
    run.parameters.resize(static_cast<Eigen::Index>(settings.parameters.size()));
    for (std::size_t j = 0; j < settings.parameters.size(); ++j)
        run.parameters(static_cast<Eigen::Index>(j)) =
            table.value(row, table.input(settings.parameters[j].name));
    run.sizes_mm = table.sizes(row, settings.fit_sizes);
    run.descriptors = table.descriptors.row(static_cast<Eigen::Index>(row)).transpose();
    return run;
}

}  // namespace

std::vector<std::size_t> PairedRuns::bases_of(const std::string& shape) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < bases.size(); ++i)
        if (bases[i].shot.shape == shape) found.push_back(i);
    return found;
}

PairedRuns read_paired_runs(const std::filesystem::path& path, const Settings& settings,
                            const std::vector<Candidate>& candidates) {
    const RunTable table(path);
    PairedRuns runs;
    runs.descriptor_names = table.descriptor_names;
    std::vector<std::optional<Eigen::Index>> columns;
    for (const Candidate& candidate : candidates) {
        columns.push_back(table.find(candidate.name));
        runs.has_column.push_back(columns.back().has_value());
    }
    std::map<std::string, std::optional<std::size_t>> base_of;  // empty: it failed
    std::vector<std::size_t> with_effect;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (changed_candidate(table, row, candidates, columns)) {
            with_effect.push_back(row);
            continue;
        }
        auto& base = base_of[pair_key(table, row, columns)];
        if (table.status[row] != 0) {
            ++runs.failed;
            continue;
        }
        base = runs.bases.size();
        runs.bases.push_back(read_base(table, row, settings));
    }
    for (const std::size_t row : with_effect) {
        const std::size_t k = *changed_candidate(table, row, candidates, columns);
        const auto base = base_of.find(pair_key(table, row, columns));
        require(base != base_of.end(),
                fmt::format("{}: no run without {} has the same seed, shape and inputs. "
                            "Signatures come in pairs: make the design again.",
                            table.where(row), candidates[k].name));
        if (table.status[row] != 0 || !base->second) {
            ++runs.failed;
            continue;
        }
        runs.effects.push_back(
            {*base->second, k, table.value(row, *columns[k]) - candidates[k].base,
             table.sizes(row, settings.fit_sizes) - runs.bases[*base->second].sizes_mm});
    }
    return runs;
}

std::vector<Eigen::VectorXd> finer_changes(const PairedRuns& coarse,
                                           const PairedRuns& finer,
                                           const std::filesystem::path& path) {
    std::vector<Eigen::VectorXd> changes(coarse.bases.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < coarse.bases.size(); ++i)
        for (const BaseRun& fine : finer.bases) {
            const BaseRun& base = coarse.bases[i];
            if (fine.run_id != base.run_id) continue;
            require(
                fine.shot.shape == base.shot.shape &&
                    is_same(fine.shot.velocity_m_s, base.shot.velocity_m_s) &&
                    fine.parameters.isApprox(base.parameters, 1e-9),
                fmt::format("{}, run {}: its inputs differ from those of the same run "
                            "among the signatures. Make the finer runs again.",
                            path.string(), fine.run_id));
            changes[i] = fine.sizes_mm - base.sizes_mm;
            ++found;
        }
    require(found > 0,
            fmt::format("{}: none of its runs is a base run of the signatures. "
                        "Make the finer runs again.",
                        path.string()));
    return changes;
}

}  // namespace taylorcal::calibrate
