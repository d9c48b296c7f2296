#include "common/errors.hpp"
#include "common/json_reader.hpp"
#include "emulator/inference/model.hpp"

#include <array>
#include <charconv>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::emulator {

namespace {

using nlohmann::json;

constexpr const char* recipe =
    "For a point x and a category value c: (1) for each input with used = true, in "
    "order, z = "
    "(t(x) - shift) / scale, with t = log10, the square root or the identity by "
    "'transform'; (2) append "
    "one "
    "number for each of category.values, 1 where it equals c, else 0; (3) with the "
    "layers of "
    "members[best] (with corrects_cheaper_runs the first without the last column of its "
    "weights), in order: z = weights z + bias, then for all layers but the last z = "
    "z / (1 "
    "+ exp(-z)); (4) output k = (z[k] * scale + shift) of outputs[k], times the product "
    "of the "
    "inputs named in its divide_by. Refuse x outside of lower..upper.";

/// A double that prints as shortly as the float does, and rounds to it.
double shortest(float value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double result = 0;
    std::from_chars(text.data(), end, result);
    return result;
}

json row_to_json(const Eigen::Ref<const Eigen::RowVectorXf>& values) {
    json list = json::array();
    for (const float value : values) list.push_back(shortest(value));
    return list;
}

json layer_to_json(const Layer& layer) {
    json weights = json::array();
    for (const auto& row : layer.weights.rowwise()) weights.push_back(row_to_json(row));
    return {{"weights", weights}, {"bias", row_to_json(layer.bias.transpose())}};
}

json member_to_json(const Member& member) {
    json layers = json::array();
    for (const Layer& layer : member.layers) layers.push_back(layer_to_json(layer));
    return {{"layers", layers},
            {"seed", member.seed},
            {"batch_size", member.batch_size},
            {"learning_rate", member.learning_rate},
            {"validation_rms", member.validation_rms}};
}

json covariance_to_json(const Covariance& covariance) {
    json matrix = json::array();
    for (const auto& row : covariance.matrix.rowwise()) {
        matrix.push_back(std::vector<double>(row.begin(), row.end()));
    }
    return {{"outputs", covariance.outputs}, {"matrix", matrix}};
}

Eigen::VectorXd vector_from(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
}

/// A list of equally long lists of numbers under `key`.
Eigen::MatrixXd matrix_from(const JsonReader& reader, std::string_view key) {
    std::vector<std::vector<double>> rows;
    try {
        rows = reader.json().at(key).get<std::vector<std::vector<double>>>();
    } catch (const json::exception&) {
        reader.fail(key, "is not a list of lists of numbers. Train again.");
    }
    if (rows.empty()) reader.fail(key, "is empty (expected a matrix). Train again.");
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                           static_cast<Eigen::Index>(rows.front().size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].size() != rows.front().size()) {
            reader.fail(key, "has rows of different lengths. Train again.");
        }
        matrix.row(static_cast<Eigen::Index>(i)) = vector_from(rows[i]).transpose();
    }
    return matrix;
}

/// A scale, which the network's numbers are divided or multiplied by.
double scale_from(const JsonReader& reader) {
    const double scale = reader.number("scale");
    if (!(scale > 0))
        reader.fail("scale",
                    fmt::format("= {} (expected more than 0). Train again.", scale));
    return scale;
}

InputInfo input_from(const JsonReader& reader) {
    InputInfo input;
    input.name = reader.text("name");
    input.transform = transform_of(reader.word("transform", transform_words()));
    input.lower = reader.number("lower");
    input.upper = reader.number("upper");
    input.shift = reader.number("shift");
    input.scale = scale_from(reader);
    input.used = reader.boolean("used", true);
    return input;
}

Member member_from(const JsonReader& reader) {
    Member member;
    for (const JsonReader& layer : reader.objects("layers")) {
        member.layers.push_back({matrix_from(layer, "weights").cast<float>(),
                                 vector_from(layer.numbers("bias")).cast<float>()});
        const Layer& read = member.layers.back();
        if (read.bias.size() != read.weights.rows()) {
            layer.fail("bias", "does not fit to the weights. Train again.");
        }
    }
    member.seed = static_cast<std::uint64_t>(reader.integer("seed"));
    member.batch_size = static_cast<int>(reader.integer("batch_size"));
    member.learning_rate = reader.number("learning_rate");
    member.validation_rms = reader.number("validation_rms");
    return member;
}

bool has_output(const Model& model, const std::string& name) {
    return std::ranges::find(model.outputs, name, &OutputInfo::name) !=
           model.outputs.end();
}

/// One row and one column for each of its outputs, all of them the model's.
Covariance covariance_from(const JsonReader& reader, const Model& model) {
    Covariance covariance{reader.texts("outputs"), matrix_from(reader, "matrix")};
    const auto count = static_cast<Eigen::Index>(covariance.outputs.size());
    if (covariance.matrix.rows() != count || covariance.matrix.cols() != count)
        reader.fail("matrix", fmt::format("is {} x {} (expected {} x {}, as there are "
                                          "outputs). Train again.",
                                          covariance.matrix.rows(),
                                          covariance.matrix.cols(), count, count));
    for (const std::string& name : covariance.outputs)
        if (!has_output(model, name))
            reader.fail("outputs", fmt::format("names \"{}\" (expected names of the "
                                               "network's outputs). Train again.",
                                               name));
    return covariance;
}

/// Held-out rows must have the network's inputs and outputs.
void check_held_out(const Model& model, const JsonReader& reader) {
    const auto inputs = static_cast<Eigen::Index>(used_inputs(model));
    if (model.held_out.places.cols() != inputs)
        reader.fail("places", fmt::format("has rows of {} numbers (expected {}, as there "
                                          "are inputs). Train again.",
                                          model.held_out.places.cols(), inputs));
    const auto outputs = static_cast<Eigen::Index>(model.outputs.size());
    if (model.held_out.errors.cols() != outputs)
        reader.fail("errors", fmt::format("has rows of {} numbers (expected {}, as there "
                                          "are outputs). Train again.",
                                          model.held_out.errors.cols(), outputs));
}

/// Layers must fit to one another and to the numbers of inputs and outputs.
void check_shapes(const Model& model, const JsonReader& reader) {
    Eigen::Index inputs = static_cast<Eigen::Index>(model.category.values.size());
    for (const InputInfo& input : model.inputs) inputs += input.used ? 1 : 0;
    if (model.corrects_cheaper_runs) ++inputs;
    for (const Member& member : model.members) {
        Eigen::Index width = inputs;
        for (const Layer& layer : member.layers) {
            if (layer.weights.cols() != width) {
                reader.fail("members",
                            "have layers that do not fit together. Train again.");
            }
            width = layer.weights.rows();
        }
        if (member.layers.empty() ||
            width != static_cast<Eigen::Index>(model.outputs.size())) {
            reader.fail("members", "do not end in the outputs named. Train again.");
        }
    }
    if (model.members.empty() || model.best >= model.members.size()) {
        reader.fail("best", "is not one of the members. Train again.");
    }
}

}  // namespace

json to_json(const Model& model) {
    json file = {{"schema", model_schema},
                 {"activation", "silu"},
                 {"recipe", recipe},
                 {"best", model.best},
                 {"corrects_cheaper_runs", model.corrects_cheaper_runs},
                 {"category", nullptr},
                 {"provenance", model.provenance},
                 {"validation", model.validation}};
    if (!model.only_shape.empty()) file["only_shape"] = model.only_shape;
    for (const InputInfo& input : model.inputs) {
        file["inputs"].push_back({{"name", input.name},
                                  {"transform", word_of(input.transform)},
                                  {"lower", input.lower},
                                  {"upper", input.upper},
                                  {"shift", input.shift},
                                  {"scale", input.scale},
                                  {"used", input.used}});
    }
    for (const OutputInfo& output : model.outputs) {
        file["outputs"].push_back({{"name", output.name},
                                   {"shift", output.shift},
                                   {"scale", output.scale},
                                   {"divide_by", output.divide_by}});
    }
    if (!model.category.values.empty()) {
        file["category"] = {{"name", model.category.name},
                            {"values", model.category.values}};
    }
    for (const Member& member : model.members) {
        file["members"].push_back(member_to_json(member));
    }
    for (const auto& [value, covariance] : model.covariances) {
        file["validation"]["covariance"][value] = covariance_to_json(covariance);
    }
    if (!model.held_out.empty()) file["validation"]["held_out"] = to_json(model.held_out);
    return file;
}

Model model_from_json(const json& file, const std::string& where) {
    const JsonReader reader(file, where);
    reader.word("schema", {model_schema});
    reader.word("activation", {"silu"});
    Model model;
    for (const JsonReader& input : reader.objects("inputs")) {
        model.inputs.push_back(input_from(input));
    }
    for (const JsonReader& output : reader.objects("outputs")) {
        model.outputs.push_back({output.text("name"), output.number("shift"),
                                 scale_from(output), output.texts("divide_by")});
    }
    if (reader.has("category") && !reader.json().at("category").is_null()) {
        const JsonReader category = reader.object("category");
        model.category = {category.text("name"), category.texts("values")};
    }
    model.only_shape = reader.text("only_shape", "");
    for (const JsonReader& member : reader.objects("members")) {
        model.members.push_back(member_from(member));
    }
    model.best = static_cast<std::size_t>(reader.integer("best"));
    model.corrects_cheaper_runs = reader.boolean("corrects_cheaper_runs", false);
    const JsonReader validation = reader.object("validation");
    model.validation = validation.json();
    model.validation.erase("covariance");
    model.validation.erase("held_out");
    if (validation.has("held_out")) {
        model.held_out = held_out_from(validation.object("held_out"));
        check_held_out(model, validation.object("held_out"));
    }
    const JsonReader covariances = validation.object("covariance");
    for (const std::string& value : covariances.keys()) {
        model.covariances.emplace_back(value,
                                       covariance_from(covariances.object(value), model));
    }
    if (model.covariances.empty())
        validation.fail("covariance",
                        "is empty (expected one by category value, or "
                        "\"all\"). Train again.");
    model.provenance = reader.object("provenance").json();
    check_shapes(model, reader);
    return model;
}

Model read_model(const std::filesystem::path& path) {
    return model_from_json(JsonReader::from_file(path).json(), path.string());
}

}  // namespace taylorcal::emulator
