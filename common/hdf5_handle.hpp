#pragma once

#include <utility>

#include <hdf5.h>

namespace taylorcal {

/// Owns one HDF5 identifier and closes it with the function that fits its kind.
class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }

    bool valid() const { return id_ >= 0; }
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

/// The library's own error stack is not shown: each failure becomes one message of ours.
inline void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

}  // namespace taylorcal
