package io.furrow.control.mission;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.device.GroupRef;

/** A group of a mission's device list with its position. */
record ListedGroup(DeviceGroup group, GroupRef ref) {}
