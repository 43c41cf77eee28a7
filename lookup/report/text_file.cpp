#include "lookup/report/text_file.h"

#include <fstream>

#include "core/error.h"

namespace voussoir {

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text && stream.flush())) throw Failure(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace voussoir
