#include "common/errors.hpp"

#include "common/simd.hpp"

#include <exception>
#include <iostream>

namespace taylorcal {

int guarded_main(const std::string& program, const std::function<int()>& body) {
    try {
        simd::variant();  // a wrong wish is an error of the whole run
        return body();
    } catch (const InputError& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 1;
    } catch (const std::exception& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 2;
    }
}

}  // namespace taylorcal
