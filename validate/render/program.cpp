#include "render/program.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "common/error.h"

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

}  // namespace gnomon::render
