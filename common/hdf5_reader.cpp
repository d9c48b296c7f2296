#include "common/errors.hpp"
#include "common/hdf5_file.hpp"
#include "common/hdf5_handle.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/core.h>
#include <unistd.h>

namespace taylorcal {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
    throw InputError(fmt::format("{}: {}", path.string(), problem));
}

/// Why nothing can be read at `path`; empty if it can, whether or not it is HDF5.
std::string unreadable(const std::filesystem::path& path) {
    std::error_code problem;
    const std::filesystem::file_status status = std::filesystem::status(path, problem);
    if (status.type() == std::filesystem::file_type::not_found)
        return "no such file. Check the name, or make the file first.";
    if (std::filesystem::is_directory(status))
        return "it is a folder (expected an HDF5 file). Give a file in it.";
    if (::access(path.c_str(), R_OK) != 0)
        return fmt::format("cannot be read ({}). Ask for the right to read it.",
                           std::strerror(errno));
    if (!std::filesystem::is_regular_file(status))
        return "it is a device, pipe or socket (expected an HDF5 file).";
    return "";
}

std::vector<hsize_t> shape_of(hid_t space) {
    const int rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    return shape;
}

std::size_t count(const std::vector<hsize_t>& shape) {
    std::size_t product = 1;
    for (const hsize_t length : shape) product *= length;
    return product;
}

/// Texts of a dataset or attribute, whether stored with fixed or with variable length.
/// `read(memory_type, buffer)` fills the buffer.
template <typename Read>
bool read_texts(hid_t type, hid_t space, std::vector<std::string>& texts,
                const Read& read) {
    if (H5Tget_class(type) != H5T_STRING) return false;
    texts.assign(count(shape_of(space)), "");
    if (texts.empty()) return true;
    if (H5Tis_variable_str(type) > 0) {
        std::vector<char*> pointers(texts.size(), nullptr);
        if (read(type, static_cast<void*>(pointers.data())) < 0) return false;
        for (std::size_t i = 0; i < texts.size(); ++i) {
            if (pointers[i] != nullptr) texts[i] = pointers[i];
        }
        H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
        return true;
    }
    const std::size_t width = H5Tget_size(type);
    std::string buffer(texts.size() * width, '\0');
    if (read(type, static_cast<void*>(buffer.data())) < 0) return false;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        texts[i] = buffer.substr(i * width, width).c_str();  // Cut at the padding.
    }
    return true;
}

/// An open dataset with its type and shape, checked against what the caller expects.
struct Dataset {
    Dataset(hid_t file, const std::filesystem::path& path, const std::string& name,
            std::size_t rank)
        : set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose),
          space(set.valid() ? H5Dget_space(set) : -1, H5Sclose),
          type(set.valid() ? H5Dget_type(set) : -1, H5Tclose) {
        if (!set.valid()) {
            fail(path,
                 fmt::format("dataset \"{}\" is missing. Is this the right kind of file? "
                             "Make it again with this version.",
                             name));
        }
        shape = shape_of(space);
        if (shape.size() != rank) {
            fail(path, fmt::format("dataset \"{}\" has {} dimensions (expected {}).",
                                   name, shape.size(), rank));
        }
    }

    Hdf5Handle set;
    Hdf5Handle space;
    Hdf5Handle type;
    std::vector<hsize_t> shape;
};

void read_numbers(const Dataset& dataset, const std::filesystem::path& path,
                  const std::string& name, hid_t memory_type, void* data) {
    const H5T_class_t kind = H5Tget_class(dataset.type);
    const bool fits =
        kind == H5T_INTEGER || (kind == H5T_FLOAT && memory_type == H5T_NATIVE_DOUBLE);
    if (!fits) {
        fail(path,
             fmt::format("dataset \"{}\" does not hold {}.", name,
                         memory_type == H5T_NATIVE_DOUBLE ? "numbers" : "integers"));
    }
    if (count(dataset.shape) == 0) return;
    if (H5Dread(dataset.set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
        fail(path,
             fmt::format("dataset \"{}\" cannot be read; the file is damaged. Delete it "
                         "and make it again.",
                         name));
    }
}

struct Attribute {
    Attribute(hid_t file, const std::filesystem::path& path, const std::string& name,
              const std::string& on)
        : attribute(
              H5Aopen_by_name(file, on.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose),
          space(attribute.valid() ? H5Aget_space(attribute) : -1, H5Sclose),
          type(attribute.valid() ? H5Aget_type(attribute) : -1, H5Tclose) {
        if (!attribute.valid()) {
            fail(path,
                 fmt::format("attribute \"{}\" of \"{}\" is missing. Is this the right "
                             "kind of file? Make it again with this version.",
                             name, on));
        }
    }

    std::vector<std::string> texts(const std::filesystem::path& path,
                                   const std::string& name) const {
        std::vector<std::string> result;
        const auto read = [this](hid_t memory, void* data) {
            return H5Aread(attribute, memory, data);
        };
        if (!read_texts(type, space, result, read)) {
            fail(path, fmt::format("attribute \"{}\" does not hold texts.", name));
        }
        return result;
    }

    Hdf5Handle attribute;
    Hdf5Handle space;
    Hdf5Handle type;
};

}  // namespace

Hdf5Reader::Hdf5Reader(std::filesystem::path path) : path_(std::move(path)) {
    silence_hdf5();
    const std::string obstacle = unreadable(path_);
    if (!obstacle.empty()) fail(path_, obstacle);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access);
    if (file_ < 0) {
        fail(path_,
             "not a whole HDF5 file (truncated, damaged or of another kind). Delete it "
             "and "
             "make it again.");
    }
}

Hdf5Reader::~Hdf5Reader() {
    if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Reader::expect_schema(const std::string& schema) const {
    const bool named = H5Aexists_by_name(file_, "/", "schema", H5P_DEFAULT) > 0;
    const std::string found = named ? text_attribute("schema") : "none";
    if (found != schema) {
        fail(path_,
             fmt::format("its schema is {} (expected {}). Give the right file, or make "
                         "it again with this version.",
                         found, schema));
    }
}

bool Hdf5Reader::has(const std::string& name) const {
    // A name is looked up step by step: asking for a link below a missing group fails.
    for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
        if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
            return false;
        if (slash == std::string::npos) return true;
    }
}

RowMatrix Hdf5Reader::matrix(const std::string& name) const {
    const Dataset dataset(file_, path_, name, 2);
    RowMatrix values(static_cast<Eigen::Index>(dataset.shape[0]),
                     static_cast<Eigen::Index>(dataset.shape[1]));
    read_numbers(dataset, path_, name, H5T_NATIVE_DOUBLE, values.data());
    return values;
}

std::vector<double> Hdf5Reader::numbers(const std::string& name) const {
    const Dataset dataset(file_, path_, name, 1);
    std::vector<double> values(dataset.shape[0]);
    read_numbers(dataset, path_, name, H5T_NATIVE_DOUBLE, values.data());
    return values;
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
    const Dataset dataset(file_, path_, name, 1);
    std::vector<std::int64_t> values(dataset.shape[0]);
    read_numbers(dataset, path_, name, H5T_NATIVE_INT64, values.data());
    return values;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
    const Dataset dataset(file_, path_, name, 1);
    std::vector<std::string> values;
    const auto read = [&](hid_t memory, void* data) {
        return H5Dread(dataset.set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    };
    if (!read_texts(dataset.type, dataset.space, values, read)) {
        fail(path_, fmt::format("dataset \"{}\" does not hold texts.", name));
    }
    return values;
}

std::string Hdf5Reader::text_attribute(const std::string& name,
                                       const std::string& on) const {
    const std::vector<std::string> values = texts_attribute(name, on);
    if (values.size() != 1) {
        fail(path_, fmt::format("attribute \"{}\" holds {} texts (expected 1).", name,
                                values.size()));
    }
    return values.front();
}

double Hdf5Reader::number_attribute(const std::string& name,
                                    const std::string& on) const {
    const Attribute attribute(file_, path_, name, on);
    double value = 0;
    if (count(shape_of(attribute.space)) != 1 ||
        H5Aread(attribute.attribute, H5T_NATIVE_DOUBLE, &value) < 0) {
        fail(path_, fmt::format("attribute \"{}\" is not a number.", name));
    }
    return value;
}

std::vector<std::string> Hdf5Reader::texts_attribute(const std::string& name,
                                                     const std::string& on) const {
    return Attribute(file_, path_, name, on).texts(path_, name);
}

}  // namespace taylorcal
