#include "solver/commands/vtk_series.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/hdf5_file.hpp"

#include <numeric>
#include <string>
#include <system_error>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

constexpr std::uint8_t vertex = 1, quadrilateral = 9;  // VTK's numbers of cell types

/// Corners of the cells, or the particles themselves [points x 3].
RowMatrix points_of(const impact::Fields& fields) {
    const bool particles = fields.corners_mm.empty();
    const std::size_t corners = particles ? 1 : 4;
    RowMatrix points(static_cast<Eigen::Index>(corners * fields.x_mm.size()), 3);
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < fields.x_mm.size(); ++i) {
        if (particles) {
            points.row(row++) << fields.x_mm[i], fields.y_mm[i], fields.z_mm[i];
            continue;
        }
        for (std::size_t a = 0; a < 4; ++a)
            points.row(row++) << fields.corners_mm[i][2 * a], 0,
                fields.corners_mm[i][2 * a + 1];
    }
    return points;
}

void write_snapshot(const std::filesystem::path& path, const impact::Fields& fields) {
    const auto cells = static_cast<std::int64_t>(fields.x_mm.size());
    const std::int64_t corners = fields.corners_mm.empty() ? 1 : 4;
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(cells * corners));
    std::iota(connectivity.begin(), connectivity.end(), std::int64_t{0});
    std::vector<std::int64_t> offsets;
    for (std::int64_t c = 0; c <= cells; ++c) offsets.push_back(c * corners);

    Hdf5Writer file(path);
    file.integers("VTKHDF/NumberOfPoints", {cells * corners});
    file.integers("VTKHDF/NumberOfCells", {cells});
    file.integers("VTKHDF/NumberOfConnectivityIds", {cells * corners});
    file.matrix("VTKHDF/Points", points_of(fields));
    file.integers("VTKHDF/Connectivity", connectivity);
    file.integers("VTKHDF/Offsets", offsets);
    file.bytes("VTKHDF/Types",
               std::vector<std::uint8_t>(fields.x_mm.size(),
                                         corners == 1 ? vertex : quadrilateral));
    const std::string data = "VTKHDF/CellData/";
    file.numbers(data + "volume_mm3", fields.volume_mm3);
    file.numbers(data + "equivalent_plastic_strain", fields.equivalent_plastic_strain);
    file.numbers(data + "temperature_K", fields.temperature_K);
    file.numbers(data + "von_mises_GPa", fields.von_mises_GPa);
    file.numbers(data + "pressure_GPa", fields.pressure_GPa);
    file.numbers(data + "grain_diameter_um", fields.grain_diameter_um);
    file.numbers(data + "weakened_fraction", fields.weakened_fraction);
    file.attribute("Version", std::vector<std::int64_t>{1, 0}, "/VTKHDF");
    file.ascii_attribute("Type", "UnstructuredGrid", "/VTKHDF");
    file.close();
}

}  // namespace

void write_vtk_series(const std::filesystem::path& folder,
                      const std::vector<impact::Fields>& snapshots) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    require(!failed, fmt::format("{}: cannot be made ({}). Choose another folder.",
                                 folder.string(), failed.message()));
    nlohmann::json files = nlohmann::json::array();
    for (std::size_t i = 0; i < snapshots.size(); ++i) {
        const std::string name = fmt::format("snapshot_{:04}.vtkhdf", i);
        write_snapshot(folder / name, snapshots[i]);
        files.push_back({{"name", name}, {"time", snapshots[i].time_us}});
    }
    const nlohmann::json series = {{"file-series-version", "1.0"}, {"files", files}};
    write_text_atomically(folder / "snapshots.vtkhdf.series", series.dump(2) + "\n");
}

}  // namespace taylorcal::commands
