// What VTK has to say when it cannot read.
#pragma once

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <iostream>
#include <sstream>
#include <string>

namespace koshi::io {

/// While it lives, what VTK says is kept instead of printed. Values that are missing at the end of a file are a warning
/// to VTK, and only text on std::cerr to its MetaImage library, so any word counts as a failure.
class VtkErrors {
 public:
  VtkErrors()
      : window_before_(vtkOutputWindow::GetInstance()),
        window_(vtkSmartPointer<Window>::New()),
        verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff()),
        stream_before_(std::cerr.rdbuf(window_->said.rdbuf())) {
    vtkOutputWindow::SetInstance(window_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~VtkErrors() {
    std::cerr.rdbuf(stream_before_);
    vtkLogger::SetStderrVerbosity(verbosity_before_);
    vtkOutputWindow::SetInstance(window_before_);
  }
  VtkErrors(const VtkErrors&) = delete;
  VtkErrors& operator=(const VtkErrors&) = delete;

  /// The first message, of one line, without VTK's own whereabouts; empty when there was none.
  std::string first() const {
    // "ERROR: In FILE, line N\nvtkReader (0x...): what is wrong\n\n", or the same without the reader's name
    std::string text = window_->said.str();
    if (text.substr(0, text.find('\n')).find(": In ") != std::string::npos) text.erase(0, text.find('\n') + 1);
    if (const auto at = text.find("): "); at != std::string::npos) text.erase(0, at + 3);
    return text.substr(0, text.find('\n'));
  }

 private:
  struct Window : vtkOutputWindow {
    static Window* New();
    void DisplayText(const char* text) override { said << text; }
    std::ostringstream said;
  };

  vtkSmartPointer<vtkOutputWindow> window_before_;
  vtkSmartPointer<Window> window_;
  vtkLogger::Verbosity verbosity_before_;
  std::streambuf* stream_before_;
};

inline vtkStandardNewMacro(VtkErrors::Window);

}  // namespace koshi::io
