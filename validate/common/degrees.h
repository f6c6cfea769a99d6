#pragma once

namespace gnomon {

/// The number of degrees, with as few digits as it takes, whose `radians` are this number to the
/// bit; the nearest where there is none (there always is for an angle that was read in degrees).
double degreesOf(double angle);

}  // namespace gnomon
