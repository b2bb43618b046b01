// SPDX-License-Identifier: BSD-3-Clause
// Registers the classes with the program that loads the library.
#include <mrpt/core/initializer.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/rtti/CObject.h>

#include "edge_octomap.h"
#include "sensor.h"

MRPT_INITIALIZER(register_edgevo) {
  mrpt::rtti::registerClass(CLASS_ID(edgevo::CEdgeOctoMap));
  mrpt::hwdrivers::CGenericSensor::registerClass(&edgevo::CEdgeVoSensor::classCEdgeVoSensor);
}
