#include "emulator/training/dataset.hpp"

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::emulator {

namespace {

/// The named columns of a matrix dataset whose attribute `names` names its columns.
RowMatrix columns(const Hdf5Reader& file, const std::filesystem::path& path,
                  const std::string& dataset, const std::vector<std::string>& wanted) {
    const RowMatrix all = file.matrix(dataset);
    const std::vector<std::string> names = file.texts_attribute("names", dataset);
    require(names.size() == static_cast<std::size_t>(all.cols()),
            fmt::format("{}: \"{}\" has {} columns but {} names. Make the file again.",
                        path.string(), dataset, all.cols(), names.size()));
    RowMatrix chosen(all.rows(), static_cast<Eigen::Index>(wanted.size()));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto found = std::ranges::find(names, wanted[i]);
        require(found != names.end(),
                fmt::format("{}: \"{}\" has no column \"{}\".{} It has: {}.",
                            path.string(), dataset, wanted[i],
                            nearest_hint(wanted[i], names, " Is \"", "\" meant?"),
                            fmt::join(names, ", ")));
        chosen.col(static_cast<Eigen::Index>(i)) = all.col(found - names.begin());
    }
    return chosen;
}

}  // namespace

Dataset read_dataset(const std::filesystem::path& path,
                     const std::vector<std::string>& input_names,
                     const std::string& category,
                     const std::vector<std::string>& output_names) {
    const Hdf5Reader file(path);
    file.expect_schema("taylorcal/database/1");
    const auto ids = file.integers("run_id");
    const auto status = file.integers("status");
    const RowMatrix inputs = columns(file, path, "inputs", input_names);
    const RowMatrix outputs = columns(file, path, "outputs", output_names);
    const std::vector<std::string> categories =
        category.empty() ? std::vector<std::string>(ids.size(), no_category)
                         : file.texts(category);
    const std::vector<std::string> shapes =
        file.has("shape") ? file.texts("shape") : std::vector<std::string>();
    const std::size_t n = ids.size();
    require(status.size() == n && categories.size() == n &&
                (shapes.empty() || shapes.size() == n) &&
                static_cast<std::size_t>(inputs.rows()) == n &&
                static_cast<std::size_t>(outputs.rows()) == n,
            fmt::format("{}: datasets of different lengths. Make the file again.",
                        path.string()));
    std::vector<Eigen::Index> kept;
    Dataset data;
    data.file = path.string();
    for (std::size_t i = 0; i < n; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        if (status[i] != 0 || !outputs.row(row).array().isFinite().any()) {
            ++data.dropped_rows;
            continue;
        }
        require(inputs.row(row).array().isFinite().all(),
                fmt::format(
                    "{}: run {} has an input that is not a number. Leave it out of the "
                    "design.",
                    path.string(), ids[i]));
        kept.push_back(row);
        data.row_ids.push_back(ids[i]);
        data.categories.push_back(categories[i]);
        if (!shapes.empty()) data.shapes.push_back(shapes[i]);
    }
    data.inputs = inputs(kept, Eigen::all);
    data.outputs = outputs(kept, Eigen::all);
    return data;
}

Dataset with_better_runs(Dataset data, const Dataset& better, const std::string& where) {
    const std::set<std::int64_t> known(data.row_ids.begin(), data.row_ids.end());
    for (const std::int64_t id : better.row_ids)
        require(!known.contains(id),
                fmt::format("{}: run {} is among those of the cheaper solver as well. "
                            "Number the runs of both without repeating any.",
                            where, id));
    const auto extend = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    const auto extend_rows = [](RowMatrix& to, const RowMatrix& from) {
        to.conservativeResize(to.rows() + from.rows(), Eigen::NoChange);
        to.bottomRows(from.rows()) = from;
    };
    data.cheaper.assign(data.row_ids.size(), 1);
    data.cheaper.resize(data.row_ids.size() + better.row_ids.size(), 0);
    extend(data.row_ids, better.row_ids);
    extend(data.categories, better.categories);
    extend(data.shapes, better.shapes);
    extend_rows(data.inputs, better.inputs);
    extend_rows(data.outputs, better.outputs);
    data.dropped_rows += better.dropped_rows;
    return data;
}

}  // namespace taylorcal::emulator
