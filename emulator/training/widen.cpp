#include "emulator/training/widen.hpp"

#include "common/errors.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::emulator {

namespace {

constexpr Eigen::Index new_input = -1;

void take_scales(InputInfo& input, const InputInfo& old, const std::string& where) {
    require(input.transform == old.transform,
            fmt::format("{}: its input \"{}\" has another transform than the "
                        "configuration gives it. Use the same one.",
                        where, old.name));
    if (!old.used) return;
    input.used = true;
    input.shift = old.shift;
    input.scale = old.scale;
}

/// For each input that the wider network uses the old network's column, or `new_input`.
std::vector<Eigen::Index> old_columns(const Model& wider, const Model& old) {
    std::vector<Eigen::Index> columns;
    for (const InputInfo& input : wider.inputs) {
        if (!input.used) continue;
        Eigen::Index column = 0, found = new_input;
        for (const InputInfo& known : old.inputs) {
            if (known.used && known.name == input.name) found = column;
            column += known.used ? 1 : 0;
        }
        columns.push_back(found);
    }
    return columns;
}

/// `kept` last columns are those of the categories, and of the cheaper solver if the old
/// network knew one; a column for it is added if only the new one does.
Member widened(const Member& old, const std::vector<Eigen::Index>& columns,
               Eigen::Index kept, Eigen::Index added) {
    Member member = old;
    const Eigen::MatrixXf& before = old.layers.front().weights;
    const auto continuous = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXf& weights = member.layers.front().weights;
    weights = Eigen::MatrixXf::Zero(before.rows(), continuous + kept + added);
    for (Eigen::Index to = 0; to < continuous; ++to) {
        const Eigen::Index from = columns[static_cast<std::size_t>(to)];
        if (from != new_input) weights.col(to) = before.col(from);
    }
    weights.middleCols(continuous, kept) = before.rightCols(kept);
    return member;
}

}  // namespace

void widen(Model& wider, const Model& old, const std::string& where) {
    for (const InputInfo& known : old.inputs) {
        const auto same = std::ranges::find(wider.inputs, known.name, &InputInfo::name);
        require(same != wider.inputs.end(),
                fmt::format("{}: its input \"{}\" is not among those of the "
                            "configuration. Add it, or train without --from.",
                            where, known.name));
        take_scales(*same, known, where);
    }
    require(old.only_shape.empty() || old.only_shape == wider.only_shape,
            fmt::format("{}: it learnt from the shape {} only (the database has {}). "
                        "Train without --from.",
                        where, old.only_shape,
                        wider.only_shape.empty() ? "several" : wider.only_shape));
    const auto names = [](const Model& model) {
        std::vector<std::string> all;
        for (const OutputInfo& output : model.outputs)
            all.push_back(output.name + " / " + fmt::format("{}", output.divide_by));
        return all;
    };
    require(names(wider) == names(old),
            fmt::format(
                "{}: its outputs are {} (expected {}, as in the configuration). Train "
                "without --from.",
                where, fmt::join(names(old), ", "), fmt::join(names(wider), ", ")));
    for (std::size_t k = 0; k < old.outputs.size(); ++k) {
        wider.outputs[k].shift = old.outputs[k].shift;
        wider.outputs[k].scale = old.outputs[k].scale;
    }
    require(wider.category.name == old.category.name &&
                wider.category.values == old.category.values,
            fmt::format("{}: it knows the {} {} (the database has {}). Train without "
                        "--from.",
                        where, old.category.name, fmt::join(old.category.values, ", "),
                        fmt::join(wider.category.values, ", ")));
    require(
        wider.corrects_cheaper_runs || !old.corrects_cheaper_runs,
        fmt::format("{}: it learnt from runs of two solvers. Give those of the better "
                    "one with --better, or train without --from.",
                    where));
    const auto kept = static_cast<Eigen::Index>(old.category.values.size() +
                                                (old.corrects_cheaper_runs ? 1 : 0));
    const Eigen::Index added = wider.corrects_cheaper_runs > old.corrects_cheaper_runs;
    const std::vector<Eigen::Index> columns = old_columns(wider, old);
    wider.members.clear();
    for (const Member& member : old.members)
        wider.members.push_back(widened(member, columns, kept, added));
}

}  // namespace taylorcal::emulator
