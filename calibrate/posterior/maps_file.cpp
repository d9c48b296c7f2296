#include "calibrate/posterior/maps_file.hpp"

namespace taylorcal::calibrate {

void write_maps(Hdf5Writer& file, const Maps& maps, const std::string& prefix) {
    for (const Map1d& map : maps.single) {
        const std::string group = prefix + "maps_1d/" + map.name;
        file.numbers(group + "/edges", map.edges);
        file.numbers(group + "/density", map.density);
        file.attribute("per", map.per, group + "/density");
    }
    for (const Map2d& map : maps.pairs) {
        const std::string group = prefix + "maps_2d/" + map.x_name + "__" + map.y_name;
        file.numbers(group + "/x_edges", map.x_edges);
        file.numbers(group + "/y_edges", map.y_edges);
        file.matrix(group + "/density", map.density);
    }
}

}  // namespace taylorcal::calibrate
