package io.furrow.control.mission;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.device.GroupRef;

/** A group of a mission's device list, and where it stands. */
record ListedGroup(DeviceGroup group, GroupRef ref) {}
