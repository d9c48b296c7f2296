#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace taylorcal {

/// What a user gave cannot work: wrong use, file, key or value. Programs exit with 1.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The computation itself failed (NaN, no convergence). Programs exit with 2.
class NumericalError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws InputError(message) unless `condition`. The message says what is wrong, why it
/// cannot work and what to do: "file: key = value (expected ...). Remedy."
inline void require(bool condition, const std::string& message) {
    if (!condition) throw InputError(message);
}

/// Runs a program's body; an exception becomes one line "program: message" on standard
/// error and the exit status: 1 wrong use or input, 2 numerical or other failure.
int guarded_main(const std::string& program, const std::function<int()>& body);

}  // namespace taylorcal
