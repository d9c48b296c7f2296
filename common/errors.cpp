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

void require_printed() {
    errno = 0;
    std::cout.flush();
    const bool whole =
        std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
    if (whole) return;
    const std::string reason = errno == 0 ? "" : std::string(", ") + std::strerror(errno);
    throw std::runtime_error("standard output: not all of the results could be written" +
                             reason +
                             ". Make room or give another place, and start "
                             "again.");
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
        std::cerr << program << ": " << error.what() << '\n';
        return 2;
    }
}

}  // namespace taylorcal
