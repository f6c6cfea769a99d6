#include "study/record.h"

#include "study/gate_record.h"

namespace gnomon {

RunStatus StudyRecord::status() const {
  return runStatus(gatesOf(*this), problems);
}

}  // namespace gnomon
