#include "common/errors.hpp"

#include "common/simd.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>

#include <fcntl.h>

namespace taylorcal {

namespace {

/// Gives the standard streams that are closed a place that nothing can be written to: the
/// next file opened would get their number, and what is printed.
void fill_closed_streams() {
    for (const int stream : {0, 1, 2})
        if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
}

/// The message of an error after which standard output is known to be incomplete.
std::string unprinted(const std::string& reason) {
    return "standard output: not all of the results could be written (" + reason +
           "). Make room or give another place, and start again.";
}

/// Throws unless all that was printed has left the program; std::cout prints to stdout.
void require_printed() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    throw std::runtime_error(errno == 0 ? "an earlier write failed"
                                        : std::strerror(errno));
}

}  // namespace

int guarded_main(const std::string& program, const std::function<int()>& body) {
    try {
        fill_closed_streams();
        simd::variant();  // a wrong wish is an error of the whole run
        const int status = body();
        require_printed();
        return status;
    } catch (const InputError& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 1;
    } catch (const std::exception& error) {
        const bool printed = std::ferror(stdout) == 0;
        std::cerr << program << ": " << (printed ? error.what() : unprinted(error.what()))
                  << '\n';
        return 2;
    }
}

}  // namespace taylorcal
