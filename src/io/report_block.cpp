#include "io/report_block.h"

#include <vtkBase64Utilities.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <bit>
#include <vector>

#include "koshi/error.h"

namespace koshi::io {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays of the format are little-endian");

constexpr std::string_view block_start = R"(<script type="application/json" id="koshi-data">)";
constexpr std::string_view block_end = "</script>";

nlohmann::ordered_json encoded_bytes(const char* dtype, const void* values, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(values);
  vtkNew<vtkZLibDataCompressor> compressor;
  std::vector<unsigned char> deflated(compressor->GetMaximumCompressionSpace(size));
  deflated.resize(compressor->Compress(bytes, size, deflated.data(), deflated.size()));
  if (deflated.empty()) throw RunError("the report's data could not be compressed");

  // Base64 writes 4 characters for 3 bytes begun.
  std::string text((deflated.size() + 2) / 3 * 4, '\0');
  text.resize(vtkBase64Utilities::Encode(deflated.data(), static_cast<unsigned long>(deflated.size()),
                                         reinterpret_cast<unsigned char*>(text.data()), 0));
  return {{"dtype", dtype}, {"encoding", "zlib+base64"}, {"data", std::move(text)}};
}

}  // namespace

nlohmann::ordered_json encoded(std::span<const float> values) {
  return encoded_bytes("f4", values.data(), values.size_bytes());
}

nlohmann::ordered_json encoded(std::span<const double> values) {
  return encoded_bytes("f8", values.data(), values.size_bytes());
}

nlohmann::ordered_json encoded(std::span<const std::int32_t> values) {
  return encoded_bytes("i4", values.data(), values.size_bytes());
}

std::string filled_template(std::string_view page, const nlohmann::ordered_json& data) {
  const std::string empty = std::string(block_start) + std::string(block_end);
  const std::size_t at = page.find(empty);
  if (at == std::string_view::npos || page.find(empty, at + 1) != std::string_view::npos)
    throw RunError("the report's template is not the one of this version: it lacks its data block");

  // "<" cannot stand in the block, or a text in the data could end the script element.
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  const std::string json = data.dump(-1, ' ', false, replace);
  std::string filled(page.substr(0, at + block_start.size()));
  filled.reserve(page.size() + json.size() + json.size() / 64);
  for (const char c : json) {
    if (c == '<')
      filled += "\\u003c";
    else
      filled += c;
  }
  return filled.append(page.substr(at + block_start.size()));
}

}  // namespace koshi::io
