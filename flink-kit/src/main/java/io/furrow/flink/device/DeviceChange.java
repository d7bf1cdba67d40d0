package io.furrow.flink.device;

import io.furrow.model.device.DeviceVersion;

/**
 * A record of {@code service.devices}.
 *
 * @param key of the record: the identity of the device
 * @param offset of the record; larger for what was written later under one key
 * @param time record timestamp, epoch ms
 * @param version null where the device was deleted
 */
public record DeviceChange(String key, long offset, long time, DeviceVersion version) {}
