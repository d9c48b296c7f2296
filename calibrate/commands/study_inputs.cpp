#include "calibrate/commands/study_inputs.hpp"

#include "calibrate/measurements/read_table.hpp"
#include "common/errors.hpp"

namespace taylorcal::calibrate {
namespace {

/// What `make` returns; its complaints begin with the name of the file they concern.
template <typename Make>
auto made_of(const std::filesystem::path& file, const Make& make) {
    try {
        return make();
    } catch (const InputError& error) {
        throw InputError(file.string() + ": " + error.what());
    }
}

DataSet data_set_of(const InputPaths& paths, const Settings& settings) {
    const std::vector<Shot> shots = read_measurements(paths.measurements);
    return made_of(paths.measurements,
                   [&] { return make_data_set(shots, settings.fit_sizes); });
}

NetworkPredictor predictor_of(const InputPaths& paths, const Settings& settings) {
    const auto emulator = emulator::Emulator::from_file(paths.emulator);
    return made_of(paths.settings, [&] { return NetworkPredictor(emulator, settings); });
}

}  // namespace

StudyInputs::StudyInputs(const InputPaths& paths)
    : settings(read_settings(paths.settings)),
      set(data_set_of(paths, settings)),
      space(settings.parameters, set.lots),
      predictor(predictor_of(paths, settings)) {
    predictor.check_ranges(set);
}

}  // namespace taylorcal::calibrate
