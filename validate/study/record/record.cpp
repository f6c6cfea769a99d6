#include "study/record/record.h"

#include "study/record/gate_record.h"

namespace gnomon {

RunStatus StudyRecord::status() const {
  return runStatus(gatesOf(*this), problems);
}

}  // namespace gnomon
