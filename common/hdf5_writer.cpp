#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/hdf5_file.hpp"
#include "common/hdf5_handle.hpp"

#include <fmt/core.h>

namespace taylorcal {

namespace {

Hdf5Handle text_type() {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

Hdf5Handle space_of(const std::vector<hsize_t>& shape) {
    const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR)
                                      : H5Screate_simple(static_cast<int>(shape.size()),
                                                         shape.data(), nullptr);
    return {space, H5Sclose};
}

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
    std::vector<const char*> result;
    result.reserve(texts.size());
    for (const std::string& text : texts) result.push_back(text.c_str());
    return result;
}

/// The library refuses a null pointer even when there is nothing to write.
const void* not_null(const void* data) {
    static const char nothing = 0;
    return data == nullptr ? &nothing : data;
}

void check(bool good, const std::string& name, const std::filesystem::path& path) {
    if (!good) {
        throw std::runtime_error(fmt::format(
            "{}: \"{}\" cannot be written. Is the memory full, or the name taken?",
            path.string(), name));
    }
}

/// Creates dataset `name` and the groups on its way; no object remembers its time of
/// creation, so that the same values give the same bytes.
void write_dataset(hid_t file, const std::filesystem::path& path, const std::string& name,
                   hid_t type, const std::vector<hsize_t>& shape, const void* data) {
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, 0);
    const Hdf5Handle space = space_of(shape);
    const Hdf5Handle set(
        H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT),
        H5Dclose);
    check(set.valid() &&
              H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, not_null(data)) >= 0,
          name, path);
}

void write_attribute(hid_t file, const std::filesystem::path& path,
                     const std::string& name, const std::string& on, hid_t type,
                     const std::vector<hsize_t>& shape, const void* data) {
    const Hdf5Handle object(H5Oopen(file, on.c_str(), H5P_DEFAULT), H5Oclose);
    const Hdf5Handle space = space_of(shape);
    const Hdf5Handle attribute(
        H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    check(attribute.valid() && H5Awrite(attribute, type, not_null(data)) >= 0,
          on + " @" + name, path);
}

}  // namespace

Hdf5Writer::Hdf5Writer(std::filesystem::path path) : path_(std::move(path)) {
    silence_hdf5();
    require_writable(path_);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    constexpr std::size_t growth = 1 << 20;
    constexpr hbool_t on_disk = 0;
    H5Pset_fapl_core(access, growth, on_disk);
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, 0);
    file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, access);
    check(file_ >= 0, "the file", path_);
}

Hdf5Writer::~Hdf5Writer() {
    if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::matrix(const std::string& name, const RowMatrix& values) {
    write_dataset(
        file_, path_, name, H5T_NATIVE_DOUBLE,
        {static_cast<hsize_t>(values.rows()), static_cast<hsize_t>(values.cols())},
        values.data());
}

void Hdf5Writer::numbers(const std::string& name, const std::vector<double>& values) {
    write_dataset(file_, path_, name, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void Hdf5Writer::integers(const std::string& name,
                          const std::vector<std::int64_t>& values) {
    write_dataset(file_, path_, name, H5T_NATIVE_INT64, {values.size()}, values.data());
}

void Hdf5Writer::bytes(const std::string& name, const std::vector<std::uint8_t>& values) {
    write_dataset(file_, path_, name, H5T_NATIVE_UINT8, {values.size()}, values.data());
}

void Hdf5Writer::texts(const std::string& name, const std::vector<std::string>& values) {
    write_dataset(file_, path_, name, text_type(), {values.size()},
                  pointers(values).data());
}

void Hdf5Writer::attribute(const std::string& name, const std::string& text,
                           const std::string& on) {
    const char* pointer = text.c_str();
    write_attribute(file_, path_, name, on, text_type(), {}, &pointer);
}

void Hdf5Writer::attribute(const std::string& name, double number,
                           const std::string& on) {
    write_attribute(file_, path_, name, on, H5T_NATIVE_DOUBLE, {}, &number);
}

void Hdf5Writer::attribute(const std::string& name, const std::vector<std::string>& texts,
                           const std::string& on) {
    write_attribute(file_, path_, name, on, text_type(), {texts.size()},
                    pointers(texts).data());
}

void Hdf5Writer::attribute(const std::string& name,
                           const std::vector<std::int64_t>& integers,
                           const std::string& on) {
    write_attribute(file_, path_, name, on, H5T_NATIVE_INT64, {integers.size()},
                    integers.data());
}

void Hdf5Writer::attribute(const std::string& name, const std::vector<double>& numbers,
                           const std::string& on) {
    write_attribute(file_, path_, name, on, H5T_NATIVE_DOUBLE, {numbers.size()},
                    numbers.data());
}

void Hdf5Writer::ascii_attribute(const std::string& name, const std::string& text,
                                 const std::string& on) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, text.size());
    write_attribute(file_, path_, name, on, type, {}, text.data());
}

void Hdf5Writer::close() {
    if (file_ < 0) return;
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "the end of the file", path_);
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    check(size > 0, "the end of the file", path_);
    std::string image(static_cast<std::size_t>(size), '\0');
    check(H5Fget_file_image(file_, image.data(), image.size()) == size,
          "the end of the file", path_);
    H5Fclose(file_);
    file_ = -1;
    write_text_atomically(path_, image);
}

}  // namespace taylorcal
