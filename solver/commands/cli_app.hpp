#pragma once

/// CLI11's application, declared only: its header is long.
namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}
