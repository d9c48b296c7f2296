#pragma once

#include "emulator/inference/held_out.hpp"
#include "emulator/inference/transform.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace taylorcal::emulator {

inline constexpr const char* model_schema = "taylorcal/emulator/1";

/// One column of the inputs. The network sees (t(x) - shift) / scale of those that are
/// `used`; the others were constant in the database and only have their value checked.
struct InputInfo {
    std::string name;
    Transform transform = Transform::linear;
    double lower = 0;  ///< Range of the database, untransformed.
    double upper = 0;
    double shift = 0;
    double scale = 1;
    bool used = true;
};

/// t(value) of an input.
inline double transformed(const InputInfo& input, double value) {
    return transformed(input.transform, value);
}
/// An input as the network sees it.
inline double standardised(const InputInfo& input, double value) {
    return (transformed(input, value) - input.shift) / input.scale;
}
/// A value on the scale on which room at the ends of a range is measured: logarithmic for
/// log10. A square root's would grow without bound towards zero.
inline double on_range_scale(const InputInfo& input, double value) {
    return input.transform == Transform::log10 ? transformed(input, value) : value;
}

/// One column of the outputs: (network * scale + shift) times the product of the inputs
/// named in `divide_by`.
struct OutputInfo {
    std::string name;
    double shift = 0;
    double scale = 1;
    std::vector<std::string> divide_by;
};

/// Words that one further input may hold; the network sees them one-hot.
struct Category {
    std::string name;
    std::vector<std::string> values;  ///< Empty when there is no such input.
};

struct Layer {
    Eigen::MatrixXf weights;  ///< [neurons x inputs of the layer]
    Eigen::VectorXf bias;
};

struct Member {
    std::vector<Layer> layers;
    std::uint64_t seed = 0;
    int batch_size = 0;
    double learning_rate = 0;
    double validation_rms = 0;  ///< Of standardised outputs.
};

/// Second moment of (database - network) over held-out rows of one category value, in
/// output units divided by `divide_by`; only of the outputs that this value has.
struct Covariance {
    std::vector<std::string> outputs;
    Eigen::MatrixXd matrix;
};

/// Everything an emulator file holds.
struct Model {
    std::vector<InputInfo> inputs;
    Category category;
    /// Of all runs that a network without category learnt from; empty where they had
    /// several, and in files of before.
    std::string only_shape;
    std::vector<OutputInfo> outputs;
    std::vector<Member> members;
    std::size_t best = 0;
    /// The first layer has a last column more: for runs of a cheaper solver, which the
    /// network learnt from as well. It is 1 for those, and 0 for what the network
    /// answers.
    bool corrects_cheaper_runs = false;
    /// By category value; one with the name "all" when there is no category.
    std::vector<std::pair<std::string, Covariance>> covariances;
    HeldOut held_out;           ///< Empty in files of before.
    nlohmann::json validation;  ///< The figures of merit, without the covariances.
    nlohmann::json provenance;
};

inline std::size_t used_inputs(const Model& model) {
    return static_cast<std::size_t>(
        std::ranges::count_if(model.inputs, &InputInfo::used));
}

nlohmann::json to_json(const Model& model);
/// InputError naming `where` when the file is not a whole emulator of this schema.
Model model_from_json(const nlohmann::json& file, const std::string& where);
/// The same from a file.
Model read_model(const std::filesystem::path& path);

}  // namespace taylorcal::emulator
