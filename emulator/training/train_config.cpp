#include "emulator/training/train_config.hpp"

#include "common/json_reader.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace taylorcal::emulator {

namespace {

int integer_in(const JsonReader& reader, std::string_view key, int lowest, int highest,
               int default_value) {
    reader.number_in(key, lowest, highest, default_value);
    return static_cast<int>(reader.integer(key, default_value));
}

/// Refuses a name that an earlier entry of the list has.
template <typename Choice>
void require_new(const JsonReader& entry, const std::string& name,
                 const std::vector<Choice>& earlier) {
    if (std::ranges::find(earlier, name, &Choice::name) != earlier.end())
        entry.fail("name", "= \"" + name + "\" is given twice. Keep one of them.");
}

std::vector<InputChoice> read_inputs(const JsonReader& reader) {
    std::vector<InputChoice> inputs;
    for (const JsonReader& input : reader.objects("inputs")) {
        input.only({"name", "transform"});
        require_new(input, input.text("name"), inputs);
        inputs.push_back(
            {input.text("name"),
             transform_of(input.word("transform", transform_words(), "linear"))});
    }
    if (inputs.empty()) reader.fail("inputs", "is empty. Name at least one input.");
    return inputs;
}

std::vector<OutputChoice> read_outputs(const JsonReader& reader,
                                       const std::vector<InputChoice>& inputs) {
    std::vector<OutputChoice> outputs;
    for (const JsonReader& output : reader.objects("outputs")) {
        output.only({"name", "divide_by"});
        OutputChoice choice{output.text("name"), {}};
        require_new(output, choice.name, outputs);
        if (output.has("divide_by")) choice.divide_by = output.texts("divide_by");
        for (const std::string& name : choice.divide_by) {
            if (std::ranges::find(inputs, name, &InputChoice::name) == inputs.end()) {
                output.fail("divide_by",
                            "names \"" + name + "\" (expected names of inputs).");
            }
        }
        outputs.push_back(std::move(choice));
    }
    if (outputs.empty()) reader.fail("outputs", "is empty. Name at least one output.");
    return outputs;
}

/// A list with at least one number, all within [lowest, highest].
template <typename Number>
std::vector<Number> list_in(const JsonReader& reader, std::string_view key, double lowest,
                            double highest, const std::vector<Number>& default_value) {
    if (!reader.has(key)) return default_value;
    std::vector<Number> list;
    for (const double value : reader.numbers(key)) {
        if (!(value >= lowest && value <= highest)) {
            reader.fail(key, "holds " + nlohmann::json(value).dump() + " (expected " +
                                 nlohmann::json(lowest).dump() + " to " +
                                 nlohmann::json(highest).dump() + ").");
        }
        list.push_back(static_cast<Number>(value));
    }
    if (list.empty()) reader.fail(key, "is empty. Give one number for each member.");
    return list;
}

}  // namespace

TrainConfig train_config_from_json(const nlohmann::json& file, const std::string& where) {
    const JsonReader reader(file, where);
    reader.only({"inputs", "category", "outputs", "hidden_layers", "neurons", "members",
                 "epochs", "batch_sizes", "learning_rates", "weight_decay",
                 "validation_fraction", "seed"});
    TrainConfig config;
    config.inputs = read_inputs(reader);
    if (reader.has("category") && !file.at("category").is_null()) {
        config.category = reader.text("category");
    }
    config.outputs = read_outputs(reader, config.inputs);
    config.hidden_layers =
        integer_in(reader, "hidden_layers", 1, 50, config.hidden_layers);
    config.neurons = integer_in(reader, "neurons", 0, 4096, config.neurons);
    config.members = integer_in(reader, "members", 1, 1000, config.members);
    config.epochs = integer_in(reader, "epochs", 1, 10'000'000, config.epochs);
    config.batch_sizes =
        list_in<int>(reader, "batch_sizes", 1, 65536, config.batch_sizes);
    config.learning_rates =
        list_in<double>(reader, "learning_rates", 1e-8, 1, config.learning_rates);
    config.weight_decay = reader.number_in("weight_decay", 0, 10, config.weight_decay);
    config.validation_fraction =
        reader.number_in("validation_fraction", 0.01, 0.9, config.validation_fraction);
    constexpr double largest_seed = 0x1p53;  // Beyond, JSON numbers lose digits.
    reader.number_in("seed", 0, largest_seed, 1);
    config.seed = static_cast<std::uint64_t>(reader.integer("seed", 1));
    config.as_given = file;
    return config;
}

TrainConfig read_train_config(const std::filesystem::path& path) {
    return train_config_from_json(JsonReader::from_file(path).json(), path.string());
}

}  // namespace taylorcal::emulator
