#include "render/program.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/lists.h"
#include "common/text.h"

namespace gnomon::render {

namespace {

constexpr std::size_t linesPerPiece = 1000000;

std::string joinPieces(const std::vector<ShaderPiece>& pieces,
                       const std::vector<std::string>& defines) {
  std::string text = "#version 450 core\n";
  for (const std::string& name : defines) text += fmt::format("#define {}\n", name);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // Lines tell the piece, too: Mesa forgets the source number of some messages.
    text += fmt::format("#line {}\n{}\n", pieces[i].firstLine + i * linesPerPiece, pieces[i].text);
  }
  return text;
}

template <typename Get, typename GetLog>
std::string infoLog(GLuint name, const Get& get, const GetLog& getLog) {
  GLint length = 0;
  get(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  getLog(name, length, nullptr, log.data());
  log.resize(log.find('\0') == std::string::npos ? log.size() : log.find('\0'));
  return log;
}

/// "0:4000014(5): error: …" (Mesa) or "0(4000014) : error …" (NVIDIA) as "FILE:14: error: …".
std::string located(const std::string& log, const std::vector<ShaderPiece>& pieces) {
  std::size_t line = 0;
  const bool found = std::sscanf(log.c_str(), "%*u:%zu", &line) == 1 ||
                     std::sscanf(log.c_str(), "%*u(%zu)", &line) == 1;
  const std::string first = log.substr(0, log.find('\n'));
  const std::size_t colon = first.find(": ");
  const std::size_t piece = line / linesPerPiece;
  if (!found || colon == std::string::npos || piece >= pieces.size()) {
    return fmt::format("{}: {}", pieces.back().file, first);
  }
  return fmt::format("{}:{}: {}", pieces[piece].file, line % linesPerPiece,
                     first.substr(colon + 2));
}

gl::Shader compile(GLenum stage, const std::vector<ShaderPiece>& pieces,
                   const std::vector<std::string>& defines) {
  const std::string text = joinPieces(pieces, defines);
  const char* source = text.c_str();
  gl::Shader shader(glCreateShader(stage));
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    throw InputError(located(infoLog(shader.name(), glGetShaderiv, glGetShaderInfoLog), pieces));
  }
  return shader;
}

}  // namespace

gl::Program makeProgram(const ProgramStages& stages, const std::vector<std::string>& defines) {
  std::vector<gl::Shader> shaders;
  shaders.push_back(compile(GL_VERTEX_SHADER, stages.vertex, defines));
  if (!stages.geometry.empty()) {
    shaders.push_back(compile(GL_GEOMETRY_SHADER, stages.geometry, defines));
  }
  shaders.push_back(compile(GL_FRAGMENT_SHADER, stages.fragment, defines));
  gl::Program program(glCreateProgram());
  for (const gl::Shader& shader : shaders) glAttachShader(program.name(), shader.name());
  glLinkProgram(program.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    throw InputError(
        located(infoLog(program.name(), glGetProgramiv, glGetProgramInfoLog), stages.fragment));
  }
  return program;
}

namespace {

using Names = std::set<std::string, std::less<>>;

/// "FILE:LINE: text"; without a line for "FILE: text".
struct Fault {
  std::string file;
  std::size_t line = 0;
  std::string text;
};

Fault faultOf(const std::string& message) {
  static const std::regex placed(R"(^(.+?):(\d+): ([\s\S]*)$)");
  std::smatch found;
  if (std::regex_match(message, found, placed)) {
    return {found[1], std::stoul(found[2]), found[3]};
  }
  const std::size_t colon = message.find(": ");
  if (colon == std::string::npos) return {"", 0, message};
  return {message.substr(0, colon), 0, message.substr(colon + 2)};
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

std::vector<std::string> quotedWords(const std::string& text) {
  static const std::regex quoted(R"([`'"]([A-Za-z_]\w*))");
  return matches(text, quoted);
}

std::vector<std::string> wordsOf(const std::string& text) {
  static const std::regex word(R"(\b([A-Za-z_]\w*)\b)");
  return matches(text, word);
}

bool saysOneOf(const std::string& text, std::initializer_list<std::string_view> phrases) {
  return std::any_of(phrases.begin(), phrases.end(), [&](std::string_view phrase) {
    return text.find(phrase) != std::string::npos;
  });
}

std::vector<const ShaderPiece*> filesOf(const Method& method) {
  std::vector<const ShaderPiece*> files = {&method.source};
  for (const ShaderPiece& include : method.includes) files.push_back(&include);
  return files;
}

/// What a line of one of the method's files says; nothing of other files.
std::optional<std::string> lineOf(const Method& method, const Fault& fault) {
  for (const ShaderPiece* piece : filesOf(method)) {
    if (piece->file != fault.file) continue;
    std::string line;
    std::istringstream text(piece->text);
    for (std::size_t row = 0; row < fault.line; ++row) std::getline(text, line);
    return line;
  }
  return std::nullopt;
}

/// The line of the method's own file that includes a file of it, or includes one that does.
std::string includedAt(const Method& method, std::string file) {
  constexpr int deepest = 32;
  for (int depth = 0; depth < deepest; ++depth) {
    const std::string name = file.substr(file.rfind('/') + 1);
    for (const ShaderPiece* piece : filesOf(method)) {
      std::istringstream text(piece->text);
      std::size_t row = 0;
      for (std::string line; piece->file != file && std::getline(text, line);) {
        ++row;
        const bool isIt = line.find("#include") != std::string::npos &&
                          saysOneOf(line, {"/" + name + "\"", "\"" + name + "\""});
        if (!isIt) continue;
        if (piece == &method.source) return fmt::format("{}:{}", piece->file, row);
        file = piece->file;
        break;
      }
    }
  }
  return "";
}

/// The message with a file and line of the method first.
std::string placedMessage(const Method& method, const Fault& fault) {
  if (lineOf(method, fault)) {
    const std::string at = fault.file == method.source.file ? "" : includedAt(method, fault.file);
    return fmt::format("{}:{}: {}{}", fault.file, fault.line, fault.text,
                       at.empty() ? "" : fmt::format(" (included at {})", at));
  }
  const std::string there =
      fault.line > 0 ? fmt::format("{}:{}", fault.file, fault.line) : fault.file;
  for (const std::string& word : quotedWords(fault.text)) {
    const auto place = placeOfWord(method.code, word);
    if (place) return fmt::format("{}: {} (found at {})", *place, fault.text, there);
  }
  const std::string& source = method.source.text;
  const auto lines = std::count(source.begin(), source.end(), '\n') +
                     (source.empty() || source.back() == '\n' ? 0 : 1);
  return fmt::format("{}:{}: {} (found after the end of this file, at {})", method.source.file,
                     lines, fault.text, there);
}

/// What a method lacks to use a name of the shared shaders: "tables = ["height"]"; empty where it
/// lacks nothing.
std::string missingFor(const std::string& word, const std::vector<SharedName>& names,
                       const std::vector<std::string>& defines) {
  std::vector<std::string> needed;
  for (const SharedName& shared : names) {
    if (shared.name != word) continue;
    if (shared.defines.empty()) return "";
    for (const std::string& define : shared.defines) {
      if (contains(defines, define)) return "";
      needed.push_back(declarationFor(define));
    }
  }
  return fmt::format("{}", fmt::join(needed, " or "));
}

/// The declaration that a name of the method's code would belong to, which nothing defines.
/// @param isSure  whether only one is wanted whose function the code has
std::string ownDeclaration(const Method& method, const std::string& word, bool isSure) {
  const std::string name = ownNameOf(word);
  if (name.empty()) return "";
  OwnPass pass;
  pass.name = name;
  MethodBake bake;
  bake.name = name;
  const bool isPass = placeOfWord(method.code, pass.function()).has_value();
  const bool isBake = placeOfWord(method.code, bake.function()).has_value();
  if (isSure && !isPass && !isBake) return "";
  if (isPass || word.ends_with("Pass")) return fmt::format("[[pass]] name = \"{}\"", name);
  return fmt::format("[{}.{}]", word.ends_with("Texture") ? "textures" : "bakes", name);
}

/// What GLSL itself has and methods use.
constexpr std::array<const char*, 44> builtIns = {
    "abs",        "acos",       "all",   "any",     "asin",    "atan",        "ceil",
    "clamp",      "cos",        "cross", "dFdx",    "dFdy",    "degrees",     "distance",
    "dot",        "exp",        "exp2",  "floor",   "fract",   "inversesqrt", "isinf",
    "isnan",      "length",     "log",   "log2",    "max",     "min",         "mix",
    "mod",        "normalize",  "pow",   "radians", "reflect", "round",       "sign",
    "sin",        "smoothstep", "sqrt",  "step",    "tan",     "texelFetch",  "textureGather",
    "textureLod", "textureSize"};

/// The structures that have a member of this name, of those that the method may use.
std::string memberHint(const std::string& word, const std::vector<SharedName>& names,
                       const std::vector<std::string>& defines) {
  std::vector<std::string> structures;
  for (const SharedName& shared : names) {
    const bool hasIt =
        contains(shared.members, word) && missingFor(shared.name, names, defines).empty();
    if (hasIt) structures.push_back(shared.name);
  }
  if (structures.empty()) return "";
  return fmt::format("; {} is a member of {}", word, fmt::join(structures, " and of "));
}

std::string nearestHint(const std::string& word, const std::vector<SharedName>& names,
                        const std::vector<std::string>& defines) {
  Names known(builtIns.begin(), builtIns.end());
  for (const SharedName& shared : names) known.insert(shared.name);
  const auto nearest = nearestName(word, known);
  if (!nearest) return "";
  const std::string needed = missingFor(*nearest, names, defines);
  return fmt::format("; did you mean {}?{}", *nearest,
                     needed.empty() ? "" : fmt::format(" To use it, declare {}", needed));
}

/// Of a name that the compiler does not know.
std::string missingHint(const std::string& word, const Method& method,
                        const std::vector<SharedName>& names,
                        const std::vector<std::string>& defines) {
  const auto declare = [&](const std::string& what) {
    return fmt::format("; to use {}, declare {}", word, what);
  };
  if (const std::string needed = missingFor(word, names, defines); !needed.empty()) {
    return declare(needed);
  }
  if (const std::string own = ownDeclaration(method, word, true); !own.empty()) return declare(own);
  for (const std::string& hint :
       {memberHint(word, names, defines), nearestHint(word, names, defines)}) {
    if (!hint.empty()) return hint;
  }
  const std::string own = ownDeclaration(method, word, false);
  return own.empty() ? "" : declare(own);
}

/// How the functions of these names are called.
std::string signatureHint(const std::vector<std::string>& words,
                          const std::vector<SharedName>& names,
                          const std::vector<std::string>& defines) {
  std::vector<std::string> signatures;
  for (const std::string& word : words) {
    for (const SharedName& shared : names) {
      const bool isThere = shared.name == word && !shared.signature.empty() &&
                           missingFor(word, names, defines).empty();
      if (isThere && !contains(signatures, shared.signature)) {
        signatures.push_back(shared.signature);
      }
    }
  }
  if (signatures.empty()) return "";
  return fmt::format("; the signature{} {}", signatures.size() == 1 ? " is" : "s are",
                     fmt::join(signatures, " and "));
}

/// Of a member or a swizzle that what stands before the dot does not have.
std::string fieldHint(const std::string& word, const std::string& line,
                      const std::vector<SharedName>& names,
                      const std::vector<std::string>& defines) {
  std::string hint = memberHint(word, names, defines);
  Names members;
  for (const SharedName& shared : names)
    members.insert(shared.members.begin(), shared.members.end());
  const auto nearest = nearestName(word, members);
  if (hint.empty() && nearest) hint = fmt::format("; did you mean {}?", *nearest);
  return hint.empty() ? signatureHint(wordsOf(line), names, defines) : hint;
}

std::string hintFor(const Fault& fault, const std::string& line, const Method& method,
                    const std::vector<SharedName>& names, const std::vector<std::string>& defines) {
  const std::vector<std::string> words = quotedWords(fault.text);
  if (saysOneOf(fault.text, {"syntax error"})) {
    // An undeclared type is one, and the message names no type.
    for (const std::string& word : wordsOf(line)) {
      const std::string needed = missingFor(word, names, defines);
      if (!needed.empty()) return fmt::format("; to use {}, declare {}", word, needed);
    }
    return "";
  }
  if (words.empty()) return "";
  if (saysOneOf(fault.text, {"no function with name", "undeclared", "undefined"})) {
    return missingHint(words.front(), method, names, defines);
  }
  if (saysOneOf(fault.text, {"no matching function", "compatible overloaded function"})) {
    const std::string hint = missingFor(words.front(), names, defines);
    return hint.empty() ? signatureHint({words.front()}, names, defines)
                        : fmt::format("; to use {}, declare {}", words.front(), hint);
  }
  if (saysOneOf(fault.text, {"swizzle"})) {  // of a number or vector, as a function returns it
    const std::string hint = signatureHint(wordsOf(line), names, defines);
    if (!hint.empty()) return hint;
  }
  if (saysOneOf(fault.text, {"swizzle", "field", "not a member"})) {
    return fieldHint(words.front(), line, names, defines);
  }
  return "";
}

}  // namespace

std::string explainedError(const std::string& message, const Method& method,
                           std::vector<SharedName> names, const std::vector<std::string>& defines) {
  Fault fault = faultOf(message);
  if (const std::size_t end = fault.text.find("; candidates are:"); end != std::string::npos) {
    fault.text.resize(end);  // the compiler's own list was on other lines
  }
  for (const ShaderPiece& piece : method.code) {
    for (SharedName& name : namesIn(piece, {})) names.push_back(std::move(name));
  }
  const std::string line = lineOf(method, fault).value_or("");
  return placedMessage(method, fault) + hintFor(fault, line, method, names, defines);
}

}  // namespace gnomon::render
