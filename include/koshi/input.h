// The input file: TOML to definition structs and back.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "koshi/definition.h"

namespace koshi::io {

/// Reads and checks a case. `overrides` are "section.key=value" (option --set): the value is TOML, or else a bare text;
/// tables of a list are named by their name or index ("boundary.root.fix", "probe.0.quantity").
/// What the file leaves open but the run decides is filled in: calibration, equations, damping, names, reductions.
/// Errors: InputError with the place of the wrong key; a file that cannot be read too.
model::Definition read_case(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same from a text; `file_name` stands in messages, and relative file names in the case start from its directory.
model::Definition read_case_text(std::string_view text, const std::string& file_name,
                                 std::span<const std::string> overrides = {});

/// The definition with the contents of the files it names: cell materials and size from body.image, cells inside each
/// surface. Errors: InputError at the key for a file that is missing, of the wrong form or size, or that has values
/// without a material; for a surface that is not closed.
model::Definition load_files(model::Definition definition);

/// The whole input with every default written out, in SI units; reading it gives an equal definition. Relative file
/// names become absolute, so that it may be read from another directory.
std::string resolved_toml(const model::Definition& definition);

/// JSON Schema of the input, with descriptions, defaults and SI units ("unit").
std::string schema_json();

}  // namespace koshi::io
