// Arrays of a report's data block, read back.
#pragma once

#include <vtkBase64Utilities.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace koshi::test {

/// The `count` numbers of an Array; none when it holds another number of them.
template <class T>
std::vector<T> decoded(const nlohmann::ordered_json& array, std::size_t count) {
  const std::string text = array.at("data");
  std::vector<unsigned char> deflated(text.size());
  deflated.resize(vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                                                   deflated.data(), deflated.size()));
  std::vector<T> values(count);
  vtkNew<vtkZLibDataCompressor> zlib;
  const std::size_t bytes = zlib->Uncompress(deflated.data(), deflated.size(),
                                             reinterpret_cast<unsigned char*>(values.data()), count * sizeof(T));
  if (bytes != count * sizeof(T)) values.clear();
  return values;
}

}  // namespace koshi::test
