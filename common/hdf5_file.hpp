#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal {

/// Row-major, as HDF5 and numpy store it.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Writes one HDF5 file atomically: it is put together in memory, and `close` writes it
/// (HDF5 1.10 itself crashes when the disk is full). Files made of the same values have
/// the same bytes (no time stamps). A name may hold slashes ("fields/temperature_K"):
/// groups are made as needed.
class Hdf5Writer {
  public:
    explicit Hdf5Writer(std::filesystem::path path);
    ~Hdf5Writer();  ///< Writes nothing unless `close` was called.
    Hdf5Writer(const Hdf5Writer&) = delete;
    Hdf5Writer& operator=(const Hdf5Writer&) = delete;

    void matrix(const std::string& name, const RowMatrix& values);
    void numbers(const std::string& name, const std::vector<double>& values);
    void integers(const std::string& name, const std::vector<std::int64_t>& values);
    void bytes(const std::string& name, const std::vector<std::uint8_t>& values);
    void texts(const std::string& name, const std::vector<std::string>& values);
    /// Attributes of the file, or of the object `on`.
    void attribute(const std::string& name, const std::string& text,
                   const std::string& on = "/");
    void attribute(const std::string& name, double number, const std::string& on = "/");
    void attribute(const std::string& name, const std::vector<std::string>& texts,
                   const std::string& on = "/");
    void attribute(const std::string& name, const std::vector<std::int64_t>& integers,
                   const std::string& on = "/");
    void attribute(const std::string& name, const std::vector<double>& numbers,
                   const std::string& on = "/");
    /// A text of fixed length in ASCII, which some readers insist on.
    void ascii_attribute(const std::string& name, const std::string& text,
                         const std::string& on = "/");
    /// Writes the file. InputError with the system's reason when it cannot be written.
    void close();

  private:
    std::filesystem::path path_;
    std::int64_t file_ = -1;
};

/// Reads such a file. InputError names the file and the remedy when it is missing,
/// truncated or lacks a dataset or attribute, or when its `schema` is another.
class Hdf5Reader {
  public:
    explicit Hdf5Reader(std::filesystem::path path);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader&) = delete;
    Hdf5Reader& operator=(const Hdf5Reader&) = delete;

    void expect_schema(const std::string& schema) const;
    bool has(const std::string& name) const;
    RowMatrix matrix(const std::string& name) const;
    std::vector<double> numbers(const std::string& name) const;
    std::vector<std::int64_t> integers(const std::string& name) const;
    std::vector<std::string> texts(const std::string& name) const;
    std::string text_attribute(const std::string& name,
                               const std::string& on = "/") const;
    double number_attribute(const std::string& name, const std::string& on = "/") const;
    std::vector<std::string> texts_attribute(const std::string& name,
                                             const std::string& on = "/") const;

  private:
    std::filesystem::path path_;
    std::int64_t file_ = -1;
};

}  // namespace taylorcal
